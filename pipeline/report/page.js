// State of a page: the chosen time, place and colours, and the update of all parts that show them.
const data = JSON.parse(document.getElementById('data').textContent);
const life = data.life || null;
const motion = data.motion ? new Motion(data.motion) : null;
const strainTime = life ? floats(life.strains.time) : null;
const duration = motion ? motion.duration : strainTime[strainTime.length - 1];
const begin = motion ? motion.data.begin : 0;
const state = {
  time: 0,
  playing: false,
  speed: 1,
  segment: life ? life.marked.segment : -1,
  colour: '',
  drawn: 0
};
let viewer = null, timeline = null, clamps = null;

const filled = (element, attributes, children) => {
  for (const [name, value] of Object.entries(attributes))
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value);
  element.append(...children);
  return element;
};
const make = (tag, attributes = {}, ...children) => filled(document.createElement(tag), attributes, children);

// Closings of cycles: damage of a segment's worst wire near a given time.
class Closings {
  constructor(rows, segments) {
    this.window = Math.max(.5, duration / 200);  // [s] to either side: one sample alone is too short to be visible
    this.of = [];
    for (const row of rows) {
      const pairs = floats(row.pairs), time = [], sum = [0];
      for (let k = 0; k < pairs.length; k += 2) {
        time.push(pairs[k]);
        sum.push(sum[sum.length - 1] + pairs[k + 1] * segments.damage[row.segment]);
      }
      this.of[row.segment] = {time, sum};
    }
  }
  around(segment, now) {
    const of = this.of[segment];
    if (!of || !of.time.length) return 0;
    const until = at => of.time[0] > at ? 0 : lastNotAbove(of.time, at) + 1;
    return of.sum[until(now + this.window)] - of.sum[until(now - this.window)];
  }
  most() {
    let most = 0;
    this.of.forEach((of, segment) => of.time.forEach(time => most = Math.max(most, this.around(segment, time))));
    return most;
  }
}
const closings = life ? new Closings(life.closings, life.segments) : null;

// ---- colours ------------------------------------------------------------------------------------------------------
const scales = {};
function findScales() {
  if (life) {
    const most = Math.max(0, ...life.segments.damage);
    const least = Math.min(...life.segments.damage.filter(damage => damage > 0), most / 2);
    if (most > 0)
      scales.damage =
          new Scale('damage per repeat (worst wire of the segment)', sequentialStops, Math.max(least, most / 1e4), most, true);
    const fastest = closings ? closings.most() : 0;
    if (fastest > 0)
      scales.rate = new Scale(`damage within ${readable(closings.window)} s of now`, sequentialStops, fastest / 1e4, fastest, true);
  }
  if (motion && motion.group('curvature')) {
    scales.curvature = new Scale('curvature now [1/m]', sequentialStops, 0, motion.range('curvature')[1], false);
    const most = Math.max(...motion.range('twist').map(Math.abs)) * 180 / Math.PI;
    scales.twist = new Scale('twist now [deg/m]', divergingStops, -most, most, false);
  }
  if (motion && motion.group('contact') && motion.range('contact')[1] > 0)
    scales.contact = new Scale('contact force now [N]', sequentialStops, 0, motion.range('contact')[1], false);
  scales.plain = new Scale('', [[0, 114, 178], [0, 114, 178]], 0, 1, false);
}
function amountOf(segment, row) {
  if (state.colour === 'damage') return life.segments.damage[segment];
  if (state.colour === 'rate') return closings.around(segment, state.time);
  if (state.colour === 'contact') return row[motion.group('contact').begin + segment];
  if (state.colour === 'curvature') return row[motion.group('curvature').begin + segment];
  if (state.colour === 'twist') return row[motion.group('twist').begin + segment] * 180 / Math.PI;
  return 0;
}
function showLegend() {
  const scale = scales[state.colour], legend = document.getElementById('legend');
  legend.hidden = !scale.title;
  legend.replaceChildren(
      make('span', {}, scale.title), make('span', {class: 'bar', style: `background:${scale.gradient()}`}),
      make(
          'span', {class: 'ends'},
          ...[scale.low, scale.middle(), scale.high].map(value => make('span', {}, readable(value, 2)))));
}

// ---- the view and its controls ------------------------------------------------------------------------------------
const icons = {
  play: '\u25b6',
  pause: '\u2759\u2759'
};
function button(words, title, action, attributes = {}) {
  return make('button', {type: 'button', title, 'aria-label': title, onclick: action, ...attributes}, words);
}
function chooser(id, label, options, value, action) {
  const list = make(
      'select', {id, onchange: event => action(event.target.value)},
      ...options.map(([key, words]) => make('option', {value: key}, words)));
  list.value = value;
  return make('label', {}, label + ' ', list);
}
function checkbox(id, words, action) {
  return make('label', {}, make('input', {type: 'checkbox', id, onchange: event => action(event.target.checked)}), ' ' + words);
}

function keyList() {
  const keys = [
    ['space', 'play, pause'], ['left, right', 'step; with shift by 5 s'], ['arrows in the view', 'turn it'], ['1 .. 5', 'views'],
    ['+ -', 'closer, farther'], ['[ ]', 'next segment to the base, to the tool'], ['n f', 'names, frames']
  ];
  return make('dl', {}, ...keys.flatMap(([key, words]) => [make('dt', {}, make('kbd', {}, key)), make('dd', {}, words)]));
}
function buildView() {
  const place = document.getElementById('view');
  if (!motion) {
    place.remove();
    return;
  }
  const stage = make('div', {id: 'stage'});
  const words = {damage: 'damage', rate: 'damage now', contact: 'contact', curvature: 'curvature', twist: 'twist', plain: 'nothing'};
  place.append(
      stage,
      make(
          'div', {class: 'controls'}, button(icons.play, 'play or pause (space)', () => play(!state.playing), {id: 'play'}),
          make('input', {
            type: 'range',
            id: 'scrub',
            min: 0,
            max: duration,
            step: .01,
            value: 0,
            'aria-label': 'time',
            oninput: event => setTime(Number(event.target.value))
          }),
          make('output', {id: 'clock'}),
          chooser(
              'speed', 'speed',
              [['0.1', '0.1'], ['0.25', '0.25'], ['0.5', '0.5'], ['1', '1'], ['2', '2'], ['5', '5'], ['10', '10']], '1',
              value => state.speed = Number(value))),
      make(
          'div', {class: 'controls'},
          data.preview ?
              '' :
              chooser('colour', 'hose coloured by', Object.keys(scales).map(key => [key, words[key]]), state.colour, setColour),
          ...[['overview', '1 all'], ['front', '2 front'], ['side', '3 side'], ['top', '4 top'], ['place', '5 near']].map(
              ([where, label]) => button(label, `view: ${where} (key ${label[0]})`, () => viewer && viewer.look(where))),
          checkbox('names', 'names', on => viewer && viewer.show('names', on)),
          checkbox('frames', 'frames', on => viewer && viewer.show('frames', on)),
          make('span', {class: 'soft'}, 'drag: turn, right drag: move, wheel: zoom, click the hose: its numbers')),
      make('p', {id: 'step', 'aria-live': 'off'}), make('details', {id: 'keys'}, make('summary', {}, 'Keys'), keyList()));
  const fail = message => stage.replaceChildren(make('p', {class: 'failed', id: 'no-view'}, message));
  if (!window.THREE || !THREE.OrbitControls) {
    fail(
        'The 3D view needs three.js, which was not installed when this page was written: apt-get install libjs-three, then write the page again (dresslife run, report or page).');
    return;
  }
  try {
    viewer = new Viewer(stage, data.scene, motion);
  } catch (problem) {
    fail(`This browser shows no 3D view (WebGL): ${problem.message}`);
    return;
  }
  stage.append(make('div', {id: 'legend'}));
  let pressed = null;
  viewer.canvas.addEventListener('pointerdown', event => pressed = [event.clientX, event.clientY]);
  viewer.canvas.addEventListener('pointerup', event => {
    const still = pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 5;
    pressed = null;
    if (!still || event.button !== 0) return;
    const size = viewer.canvas.getBoundingClientRect(),
          segment = viewer.segmentAt(event.clientX - size.left, event.clientY - size.top);
    if (segment >= 0) choose(segment);
    else if (clamps) clamps.place(event.clientX - size.left, event.clientY - size.top);
  });
  const panel = document.getElementById('clamp');
  if (panel && motion.group('link_positions') && viewer.clampGroups) clamps = new Clamps(viewer, data.scene, motion, panel);
  if (life) viewer.mark(viewer.marked, life.marked.segment);
}

// ---- actions of the reader ----------------------------------------------------------------------------------------
function choose(segment) {
  state.segment = segment;
  if (viewer) viewer.mark(viewer.chosen, segment === life?.marked.segment ? -1 : segment);
  document.body.dataset.segment = segment;
  showPlace();
  showSection();
  fillTimeline();
}
function setColour(colour) {
  state.colour = scales[colour] ? colour : 'plain';
  const list = document.getElementById('colour');
  if (list) list.value = state.colour;
  if (viewer) showLegend();
  setTime(state.time);
}
function setTime(time) {
  state.time = Math.min(Math.max(time, 0), duration);
  const words = `${(begin + state.time).toFixed(2)} of ${(begin + duration).toFixed(2)} s`;
  if (motion) {
    const row = motion.goTo(state.time);
    if (viewer) viewer.pose(row, segment => scales[state.colour].colour(amountOf(segment, row)));
    document.getElementById('scrub').value = state.time;
    document.getElementById('clock').textContent = words;
    document.getElementById('step').textContent = lineWords(state.time) || '\u00a0';
  }
  if (timeline) timeline.moveTo(state.time);
  document.body.dataset.time = (begin + state.time).toFixed(3);
  if (loopPoint) loopPoint(state.time);
  showNow();
}
function play(on) {
  state.playing = on && duration > 0;
  if (state.playing && state.time >= duration) setTime(0);
  const element = document.getElementById('play');
  if (element) element.textContent = state.playing ? icons.pause : icons.play;
  document.body.dataset.playing = state.playing;
}
function onKey(event) {
  if (event.ctrlKey || event.altKey || event.metaKey ||
      ['INPUT', 'SELECT', 'TEXTAREA'].includes(event.target.tagName) && event.target.type !== 'checkbox')
    return;
  const onCanvas = viewer && event.target === viewer.canvas, step = event.shiftKey ? 5 : .1;
  const views = {1: 'overview', 2: 'front', 3: 'side', 4: 'top', 5: 'place'};
  const turns = {ArrowLeft: [-.1, 0], ArrowRight: [.1, 0], ArrowUp: [0, .1], ArrowDown: [0, -.1]};
  if (event.key === ' ') {
    if (event.target.tagName === 'BUTTON') return;
    play(!state.playing);
  } else if (onCanvas && turns[event.key]) viewer.turn(...turns[event.key], 1);
  else if (event.key === 'ArrowLeft' || event.key === ',') setTime(state.time - step);
  else if (event.key === 'ArrowRight' || event.key === '.') setTime(state.time + step);
  else if (viewer && views[event.key]) viewer.look(views[event.key]);
  else if (viewer && (event.key === '+' || event.key === '-')) viewer.turn(0, 0, event.key === '+' ? .85 : 1.18);
  else if (life && (event.key === '[' || event.key === ']'))
    choose(Math.min(Math.max(state.segment + (event.key === ']' ? 1 : -1), 0), life.segments.damage.length - 1));
  else if (event.key === 'n' || event.key === 'f') document.getElementById(event.key === 'n' ? 'names' : 'frames')?.click();
  else return;
  event.preventDefault();
}

// ---- frame by frame -----------------------------------------------------------------------------------------------
let before = 0, spent = [];
function frame(now) {
  if (state.playing) {
    const next = state.time + state.speed * Math.min((now - before) / 1000, .25);
    const start = performance.now();
    setTime(next);
    if (next >= duration) play(false);
    if (viewer) viewer.draw();
    spent.push(performance.now() - start);
  } else if (viewer && viewer.dirty) {
    const start = performance.now();
    viewer.draw();
    spent.push(performance.now() - start);
  }
  before = now;
  if (spent.length >= 10) {
    const mean = spent.reduce((a, b) => a + b, 0) / spent.length;
    document.body.dataset.frame = mean.toFixed(2);
    document.getElementById('frame-time')?.replaceChildren(` A frame takes ${mean.toFixed(1)} ms.`);
    spent = [];
  }
  requestAnimationFrame(frame);
}
function tellWhatIsShown() {
  const place = document.getElementById('shown');
  if (!place || !motion) return;
  const {keys, samples, stride, groups} = motion.data;
  let words = `The view joins ${keys} of ${samples} samples by straight lines`;
  if (stride > 1) words += ` (of every ${stride} samples one was looked at)`;
  words += `: places are right within ${readable(1000 * groups.points.miss * Math.sqrt(3), 2)} mm at every sample`;
  if (groups.curvature)
    words += `, curvature within ${readable(groups.curvature.miss, 2)} 1/m, twist within ${
        readable(groups.twist.miss * 180 / Math.PI, 2)} deg/m`;
  if (data.preview) {
    place.replaceChildren(make('span', {id: 'frame-time'}));
    return;
  }
  place.replaceChildren(words + '; damage, lives and largest values are those of the files.', make('span', {id: 'frame-time'}));
}

// Adds names and frames, the moment of the refusal, and marks the links that the refusal names in a warning colour.
function openPreview() {
  for (const id of ['names', 'frames']) document.getElementById(id)?.click();
  if (data.preview.refusal_time !== null) setTime(data.preview.refusal_time - begin);
  if (!viewer) return;
  const named = data.scene.links.map(
      link => new RegExp(`\\b${link.name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}\\b`).test(data.preview.refusal));
  viewer.warnOf(named);
  const [tube, more] = viewer.tubes, share = data.preview.refusal_share;
  if (share !== null && !more) viewer.mark(viewer.marked, Math.min(Math.floor(share * tube.segments), tube.segments - 1));
  if (data.preview.refusal) viewer.look('place');
}

// #t=12.5&segment=30&colour=twist&view=top&play=1: a link to the present view.
function followLink() {
  const wish = new URLSearchParams(location.hash.slice(1));
  if (wish.has('colour')) setColour(wish.get('colour'));
  if (wish.has('t')) setTime(Number(wish.get('t')) - begin);
  if (wish.has('segment') && life && life.segments.damage[Number(wish.get('segment'))] !== undefined)
    choose(Number(wish.get('segment')));
  if (wish.has('names')) document.getElementById('names')?.click();
  if (viewer && ['overview', 'front', 'side', 'top', 'place'].includes(wish.get('view'))) viewer.look(wish.get('view'));
  if (wish.get('play')) play(true);
}

findScales();
state.colour = scales.damage ? 'damage' : Object.keys(scales)[0];
buildView();
buildTimeline();
buildWire();
if (viewer) showLegend();
setTime(life && life.marked.segment >= 0 && life.damage_per_repeat > 0 ? life.marked.time - begin : 0);
if (life && state.segment >= 0) choose(state.segment);
if (data.preview) openPreview();
tellWhatIsShown();
document.addEventListener('keydown', onKey);
window.addEventListener('hashchange', followLink);
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
  fillTimeline();
  redrawSection();
  if (viewer) viewer.dirty = true;
});
// Uses light colours for paper; pictures that are drawn once keep their colours.
function onPaper(yes) {
  document.documentElement.classList.toggle('paper', yes);
  fillTimeline();
  redrawSection();
  if (viewer) viewer.draw();
}
window.addEventListener('resize', redrawSection);
window.addEventListener('beforeprint', () => {
  play(false);
  onPaper(true);
});
window.addEventListener('afterprint', () => onPaper(false));
followLink();
window.dresslife = {
  state,
  setTime,
  choose,
  setColour,
  play,
  viewer: () => viewer,
  timeline: () => timeline,
  clamps: () => clamps,
  closings,
  motion,
  life,
  data
};
requestAnimationFrame(now => {
  before = now;
  frame(now);
  document.body.dataset.ready = 'true';
});
