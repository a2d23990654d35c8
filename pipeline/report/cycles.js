// The wire that breaks first: a chart of its cycles by range and mean, and of its stress over strain.
const svgNames = new DOMParser().parseFromString('<svg></svg>', 'text/html').querySelector('svg').namespaceURI;
const drawing = (tag, attributes = {}, ...children) => filled(document.createElementNS(svgNames, tag), attributes, children);
const chart = {width: 420, height: 330, left: 62, right: 12, top: 10, bottom: 44};
const chartX = part => chart.left + part * (chart.width - chart.left - chart.right);
const chartY = part => chart.height - chart.bottom - part * (chart.height - chart.top - chart.bottom);

function axes(xTitle, yTitle, [xLow, xHigh], [yLow, yHigh]) {
  const group = drawing('g', {class: 'axes'});
  const ticks = (low, high, most, put) => {
    if (!(high > low)) return put(low, 0.5);
    const step = roundStep((high - low) / most);
    for (let k = Math.ceil(low / step); k * step <= high; ++k) put(k * step, (k * step - low) / (high - low));
  };
  ticks(xLow, xHigh, 5, (value, part) => group.append(
      drawing('line', {x1: chartX(part), x2: chartX(part), y1: chartY(0), y2: chartY(1)}),
      drawing('text', {x: chartX(part), y: chartY(0) + 16, 'text-anchor': 'middle'}, readable(value))));
  ticks(yLow, yHigh, 6, (value, part) => group.append(
      drawing('line', {x1: chartX(0), x2: chartX(1), y1: chartY(part), y2: chartY(part)}),
      drawing('text', {x: chartX(0) - 6, y: chartY(part) + 4, 'text-anchor': 'end'}, readable(value))));
  group.append(
      drawing('text', {x: chartX(.5), y: chart.height - 8, 'text-anchor': 'middle'}, xTitle),
      drawing('text', {transform: `translate(13 ${chartY(.5)}) rotate(-90)`, 'text-anchor': 'middle'}, yTitle));
  return group;
}
function chartFigure(id, title, words, label, ...parts) {
  return make(
      'figure', {id}, make('h3', {}, title),
      drawing('svg', {viewBox: `0 0 ${chart.width} ${chart.height}`, role: 'group', 'aria-label': label}, ...parts),
      make('figcaption', {class: 'soft'}, words));
}

function cycleMatrix() {
  const {cells, range, low_mean: lowMean, high_mean: highMean, rows} = life.cycles;
  const total = rows.reduce((sum, row) => sum + row[3], 0), most = Math.max(...rows.map(row => row[3]));
  const scale = new Scale('', sequentialStops, most / 1e4, most, true);
  const meanOf = part => 100 * (lowMean + part * (highMean - lowMean)), rangeOf = part => 100 * range * part;
  const wide = chartX(1 / cells) - chartX(0), high = chartY(0) - chartY(1 / cells);
  const squares = rows.map(([column, line, count, damage, time]) => {
    const go = () => {
      choose(life.worst_segment);
      setTime(time - begin);
    };
    const words = `${readable(count)} cycles a repeat, range ${readable(rangeOf(line / cells))} .. ${readable(rangeOf((line + 1) / cells))} %, mean ` +
        `${readable(meanOf(column / cells))} .. ${readable(meanOf((column + 1) / cells))} %: ${readable(100 * damage / (total || 1))} % of the ` +
        `damage, most of it closing at ${time.toFixed(2)} s`;
    return drawing(
        'rect', {
          x: chartX(column / cells),
          y: chartY((line + 1) / cells),
          width: wide,
          height: high,
          fill: css(scale.colour(damage)),
          tabindex: 0,
          role: 'button',
          'aria-label': words,
          onclick: go,
          onkeydown: event => {
            if (event.key !== 'Enter') return;
            event.preventDefault();
            go();
          }
        },
        drawing('title', {}, words));
  });
  const counted = rows.reduce((sum, row) => sum + row[2], 0), leading = rows.reduce((a, b) => b[3] > a[3] ? b : a);
  const words = most > 0 ?
      `${readable(counted)} cycles a repeat, coloured by damage (logarithmic, grey: none or below 0.01 % of the most). The cell that costs ` +
          `most holds ${readable(leading[2])} of them and ${readable(100 * leading[3] / total)} % of the damage. A click goes to where its worst closes.` :
      `${readable(counted)} cycles a repeat, none of which does damage.`;
  return chartFigure(
      'cycles', 'Cycles by range and mean', words, 'Cycles by range and mean of strain',
      axes('mean strain [%]', 'range of strain [%]', [meanOf(0), meanOf(1)], [0, rangeOf(1)]), ...squares);
}

let loopPoint = null;
function hysteresis() {
  const {loops} = life, time = floats(loops.time);
  const strain = unpacked(loops.strain, 100), stress = unpacked(loops.stress, 1e-6);
  const x = around(strain), y = around(stress, 0);
  const place = k => [chartX((strain[k] - x.low) / (x.high - x.low)), chartY((stress[k] - y.low) / (y.high - y.low))];
  let path = '';
  for (let k = 0; k < time.length; ++k) path += `${k ? 'L' : 'M'}${place(k).map(value => value.toFixed(1)).join(' ')}`;
  const point = drawing('circle', {r: 5, class: 'now'});
  loopPoint = now => {
    const [cx, cy] = place(lastNotAbove(time, now));
    point.setAttribute('cx', cx);
    point.setAttribute('cy', cy);
  };
  return chartFigure(
      'loops', 'Stress over strain',
      `Along the motion, as its damage was evaluated: ${loops.rule}. The point is now.`,
      'Stress over strain', axes('strain [%]', 'stress [MPa]', [x.low, x.high], [y.low, y.high]),
      drawing('path', {d: path, class: 'loop'}), point);
}

function buildWire() {
  const place = document.getElementById('wire');
  if (!place || !life || life.worst_segment < 0) return;
  const figures = [...(life.cycles ? [cycleMatrix()] : []), ...(life.loops ? [hysteresis()] : [])];
  if (figures.length) place.append(make('h2', {}, `The wire that breaks first: ${life.worst_component}`), make('div', {class: 'figures'}, ...figures));
}
