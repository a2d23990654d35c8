// The panels of the timeline: strain and damage of the chosen place, its shape, the joints, the program; in a preview the
// distance of the clamps.
const unpacked = (of, factor) => Float64Array.from(wholeNumbers(of.numbers), steps => factor * (of.low + of.step * steps));
function strainOf(segment) {
  const row = life.strains.rows.find(one => one.segment === segment);
  if (!row) return null;
  row.values = row.values || unpacked(row.numbers, 100);
  row.at = row.at || (row.time ? floats(row.time) : strainTime);
  return row;
}
function around(values, ...more) {
  let low = more.length ? Math.min(...more) : Infinity, high = more.length ? Math.max(...more) : -Infinity;
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  const room = (high - low) * .05 || 1e-6;
  return {low: low - room, high: high + room};
}
// Turning points of the worst wire, if the history of another wire is shown.
function drawTurns(context, panel, line, colour) {
  const turns = life.strains.turns;
  turns.values = turns.values || unpacked(turns.strain, 100);
  turns.at = turns.at || floats(turns.time);
  context.fillStyle = colour;
  for (let k = 0; k < turns.at.length; ++k) {
    context.beginPath();
    context.arc(line.xAt(turns.at[k]), line.yAt(panel, turns.values[k]), 1.6, 0, 2 * Math.PI);
    context.fill();
  }
}
function strainPanel(colours) {
  const row = strainOf(state.segment), title = 'strain [%]';
  if (!row) return {title: 'strain: no history of this place is in the page', height: 12};
  const turns = row.wire && state.segment === life.worst_segment && life.strains.turns;
  const how = !row.sampled ? ', straight between its turning points' :
      life.strains.thinned ? ', extremes of short stretches' :
                             '';
  const other = row.wire ? ` (${readable(100 * row.damage / life.segments.damage[state.segment])} % of the damage of the worst wire there` +
          `${turns ? '; dots: where the worst turns' : ''})` : '';
  return {
    title: `${title} of ${row.wire || wireWords(state.segment)}${other}${how}`,
    brief: row.wire ? `${title}, ${readable(100 * row.damage / life.segments.damage[state.segment])} % of the worst\u2019s damage` : `${title}${how}`,
    height: 120,
    ...around(row.values),
    curves: [{time: row.at, values: row.values, colour: colours.blue}],
    draw: (context, panel, line) => turns && drawTurns(context, panel, line, colours.hot),
    words: time => `strain ${valueAt(row.at, row.values, time).toFixed(4)} %`
  };
}
function damagePanel(colours) {
  const row = life.closings.find(one => one.segment === state.segment);
  if (!row) return null;
  const pairs = floats(row.pairs);
  let most = 0;
  for (let k = 1; k < pairs.length; k += 2) most = Math.max(most, 100 * pairs[k]);
  return {
    title: 'damage there [% of its own], where cycles close',
    height: 60,
    low: 0,
    high: most * 1.05 || 1,
    draw: (context, panel, line) => {
      context.strokeStyle = colours.hot;
      context.lineWidth = 1.6;
      context.beginPath();
      for (let k = 0; k < pairs.length; k += 2) {
        const x = line.xAt(pairs[k]);
        context.moveTo(x, panel.top + panel.height);
        context.lineTo(x, line.yAt(panel, 100 * pairs[k + 1]));
      }
      context.stroke();
    },
    words: time => {
      let near = -1;
      for (let k = 0; k < pairs.length; k += 2)
        if (Math.abs(pairs[k] - time) < duration / 300 && (near < 0 || pairs[k + 1] > pairs[near + 1])) near = k;
      return near < 0 ? '' : `${readable(100 * pairs[near + 1])} % of the damage at ${(begin + pairs[near]).toFixed(2)} s`;
    }
  };
}
function shapePanels(colours) {
  if (!motion || !motion.group('curvature')) return [];
  const panels = [];
  for (const [name, title, factor, colour] of [
           ['curvature', 'curvature there [1/m]', 1, colours.blue],
           ['twist', 'twist there [deg/m]', 180 / Math.PI, colours.hot]]) {
    const values = motion.history(name, state.segment).map(value => factor * value);
    panels.push({
      title,
      height: 54,
      ...around(values, 0),
      curves: [{time: motion.time, values, colour}],
      words: time => `${name} ${readable(valueAt(motion.time, values, time))}`
    });
  }
  return panels;
}
function jointPanel() {
  const group = motion && motion.group('joints');
  if (!group) return null;
  const curves = Array.from({length: group.size}, (_, k) => ({
                                                    time: motion.time,
                                                    colour: jointColours[k % jointColours.length],
                                                    name: (data.scene.joints[k] || `${k + 1}`),
                                                    values: motion.history('joints', k).map(value => value * 180 / Math.PI)
                                                  }));
  const all = [].concat(...curves.map(curve => [Math.min(...curve.values), Math.max(...curve.values)]));
  return {title: 'joints [deg]', height: 110, ...around(all), curves};
}
function programPanel(colours) {
  const {begin: begins, line, text, damage} = life ? life.program : data.program,
                                    total = damage ? damage.reduce((a, b) => a + b, 0) : 0;
  return {
    title: 'line of the program',
    height: 18,
    draw: (context, panel, axis) => {
      for (let k = 0; k < begins.length; ++k) {
        const from = axis.xAt(begins[k]), to = axis.xAt(k + 1 < begins.length ? begins[k + 1] : duration);
        if (to < 0 || from > axis.width || to - from < .3) continue;
        const costly = total > 0 && line[k] >= 0 && damage[line[k]] > .03 * total;
        context.fillStyle = costly ? colours.hot : k % 2 ? colours.band : colours.band2;
        context.globalAlpha = costly ? .6 : 1;
        context.fillRect(from, panel.top, to - from, panel.height);
        context.globalAlpha = 1;
        context.fillStyle = colours.ink;
        context.textAlign = 'center';
        if (line[k] >= 0 && to - from > 22)
          context.fillText(String(line[k] + 1), (Math.max(from, leftMargin) + Math.min(to, axis.width)) / 2, panel.top + 13);
      }
    },
    words: time => lineWords(time)
  };
}
// For a preview: distance of the clamps of each span, and the length of the span.
function wayPanel(colours) {
  if (!data.preview || !data.preview.ways.spans.length) return null;
  const {time, spans} = data.preview.ways, all = [].concat(...spans.map(span => [span.length, ...span.ways]));
  return {
    title: 'clamps apart [m], dashed: the length',
    height: 130,
    ...around(all),
    curves: spans.map((span, k) => ({time, values: span.ways, colour: jointColours[k % jointColours.length], name: span.name})),
    draw: (context, panel, line) => {
      context.setLineDash([6, 4]);
      spans.forEach((span, k) => {
        context.strokeStyle = jointColours[k % jointColours.length];
        context.beginPath();
        context.moveTo(leftMargin, line.yAt(panel, span.length));
        context.lineTo(line.width - rightMargin, line.yAt(panel, span.length));
        context.stroke();
      });
      context.setLineDash([]);
    },
    words: at => spans.map(span => `${readable(valueAt(time, span.ways, at), 4)} m apart`).join(', ')
  };
}
function lineWords(time) {
  const program = life ? life.program : data.program;
  if (!program || !program.begin.length) return '';
  const line = program.line[lastNotAbove(program.begin, time + 1e-6)];
  return line >= 0 ? `line ${line + 1}: ${program.text[line]}` : data.preview ? 'the mounting pose, before the program' : '';
}
function buildTimeline() {
  const place = document.getElementById('timeline');
  if (!(duration > 0) || !place) return;
  timeline = new Timeline(place, duration, setTime);
  fillTimeline();
}
function fillTimeline() {
  if (!timeline) return;
  timeline.draw();
  const colours = timeline.colours, ofLife = life && state.segment >= 0;
  timeline.setPanels([
    wayPanel(colours), ofLife && strainPanel(colours), ofLife && damagePanel(colours),
    ...(state.segment >= 0 ? shapePanels(colours) : []), jointPanel(), programPanel(colours)
  ].filter(Boolean));
}
