// The numbers of the chosen place of a dresspack.
function dresspackOf(segment) {
  return motion ?
      motion.data.lines.findIndex(line => segment >= line.first_segment && segment < line.first_segment + line.segments) :
      0;
}
// Returns the number of a segment counted from the tool, from 1, and the distance of its middle from the tool [m].
function fromTool(segment) {
  const own = life.segments.dresspack[segment];
  let count = 1, distance = life.segments.length[segment] / 2;
  for (let k = segment + 1; k < life.segments.length.length && life.segments.dresspack[k] === own; ++k, ++count)
    distance += life.segments.length[k];
  return {count, distance};
}
function placeWords(segment) {
  const {count, distance} = fromTool(segment), hose = data.scene && data.scene.hoses[dresspackOf(segment)];
  return `segment ${count} from the tool (${distance.toFixed(2)} m)${hose && hose.name ? ` of the ${hose.name}` : ''}`;
}
const wireWords = segment => life.segments.wire[segment] || 'its worst wire';

function showPlace() {
  const place = document.getElementById('place');
  if (!place || !life || state.segment < 0) return;
  const s = state.segment, segments = life.segments, damage = segments.damage[s], rows = [];
  const row = (name, words, value) =>
      rows.push(make('dt', {}, name), make('dd', value === undefined ? {} : {'data-name': name, 'data-value': value}, words));
  const jump = (time, words) => button(words, `go to ${time.toFixed(2)} s`, () => setTime(time - begin), {class: 'link'});
  row('damage',
      damage > 0 ? `${readable(damage)} per repeat, ${readable(100 * damage / Math.max(...segments.damage))} % of the worst` :
                   'none',
      damage);
  if (damage > 0) row('life', `${readable(life.repeat_seconds / 3600 / damage)} h, ${readable(1 / damage)} repeats`, 1 / damage);
  row('worst wire', segments.wire[s] || 'none');
  if (segments.largest_curvature) {
    const curvature = segments.largest_curvature[s], when = segments.largest_curvature_time[s];
    row('largest curvature',
        make(
            'span', {}, `${readable(curvature)} 1/m (radius ${readable(1 / curvature)} m) `,
            jump(when, `at ${when.toFixed(2)} s`)),
        curvature);
    row('twist',
        `${readable(segments.least_twist[s] * 180 / Math.PI)} .. ${readable(segments.largest_twist[s] * 180 / Math.PI)} deg/m`,
        segments.largest_twist[s]);
  }
  if (segments.hose_damage)
    row('hose\u2019s wall',
        `${readable(100 * segments.hose_damage[s] / (Math.max(...segments.hose_damage) || 1))} % of the damage of its worst place`,
        segments.hose_damage[s]);
  rows.push(make('dt', {}, 'now'), make('dd', {id: 'now'}));
  const marked = life.marked.segment, worst = life.worst_segment;
  const what = s === marked ? `: ${life.marked.words}` : s === worst ? ': the worst wire' : '';
  place.replaceChildren(make('h2', {}, placeWords(s) + what), make('dl', {'aria-live': 'polite'}, ...rows));
  const offer = (words, segment) =>
      place.append(button(words, `choose the place: ${words}`, () => choose(segment), {class: 'link'}), ' ');
  if (marked >= 0 && s !== marked) offer(life.marked.words, marked);
  if (worst >= 0 && worst !== marked && s !== worst) offer('the worst wire', worst);
  showNow();
}
function showNow() {
  const now = document.getElementById('now');
  if (!now || !motion || !motion.group('curvature')) return;
  const curvature = motion.row[motion.group('curvature').begin + state.segment],
        twist = motion.row[motion.group('twist').begin + state.segment];
  now.textContent = `curvature ${readable(curvature)} 1/m, twist ${readable(twist * 180 / Math.PI)} deg/m`;
}
