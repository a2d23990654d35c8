// Cross-section of the chosen segment: the whole dresspack and one of its cables enlarged, every wire coloured by its damage, and
// a list of the most damaged wires.
class CrossSection {
  constructor(of) {
    this.of = of;
    this.parts = [];
    this.wires = [];
    this.collect(of.parts, 0, 0, of.name ? of.name + '/' : '', []);
  }
  // For each part its position [m], its path and the parts that contain it.
  collect(layers, x, y, before, holders) {
    for (const layer of layers)
      for (let k = 0; k < layer.count; ++k) {
        const angle = layer.phase + 2 * Math.PI * k / layer.count;
        const part = {
          x: x + layer.at * Math.cos(angle),
          y: y + layer.at * Math.sin(angle),
          radius: layer.radius,
          path: `${before}${layer.layer ? layer.layer + '/' : ''}${layer.name} ${k + 1}`,
          plain: layer.plain,
          holders
        };
        const wire = !layer.parts.length && !layer.plain;
        (wire ? this.wires : this.parts).push(part);
        this.collect(layer.parts, part.x, part.y, part.path + '/', [...holders, part]);
      }
  }
  whole() { return {x: 0, y: 0, radius: this.of.radius}; }
  // Returns the part that is enlarged around a wire: the widest part that contains it and is much narrower than the dresspack.
  nearPart(wire) { return wire && wire.holders.find(part => part.radius < .5 * this.of.radius) || this.whole(); }
  // Returns the smallest part at a position [m]; null: none.
  at(x, y, among) {
    const inside = part => Math.hypot(part.x - x, part.y - y) <= part.radius;
    return among.filter(inside).reduce((least, part) => !least || part.radius < least.radius ? part : least, null);
  }
}
let crossSections = [], sectionScale = null;
function prepareSections() {
  crossSections = data.section.dresspacks.map(of => new CrossSection(of));
  sectionScale = new Scale('damage per repeat', sequentialStops, data.section.low, data.section.high, true);
}

// Returns the damage of each wire of a segment's row; 0: below the begin of the scale.
function damagesOf(row, count) {
  const bytes = new Uint8Array(bytesOf(row.levels)), {steps, low, high} = data.section;
  return Array.from({length: count}, (_, k) => {
    const level = bytes[k >> 1] >> k % 2 * 4 & 15;
    return level ? low * (high / low) ** ((level - 1) / (steps - 1)) : 0;
  });
}

function drawCrossSection(canvas, section, damages, view, marked, larger) {
  const ratio = Math.min(window.devicePixelRatio || 1, 2), side = Math.max(canvas.clientWidth, 120);
  if (!matchMedia('print').matches || !canvas.dataset.side) canvas.dataset.side = Math.round(side * ratio);
  canvas.width = canvas.height = Number(canvas.dataset.side);
  const context = canvas.getContext('2d'), scale = canvas.width / (2.12 * view.radius);
  const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const ground = colour('--page'), band = colour('--band'), rule = colour('--soft'), ink = colour('--ink');
  const disc = (at, radius, fill, stroke, width = 1) => {
    context.beginPath();
    context.arc(canvas.width / 2 + scale * (at.x - view.x), canvas.width / 2 - scale * (at.y - view.y), radius, 0, 2 * Math.PI);
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    if (stroke) {
      context.strokeStyle = stroke;
      context.lineWidth = width * ratio;
      context.stroke();
    }
  };
  context.fillStyle = ground;
  context.fillRect(0, 0, canvas.width, canvas.width);
  const centre = {x: 0, y: 0};
  disc(centre, scale * section.of.radius, rule);
  disc(centre, scale * section.of.inner, ground);
  if (section.of.core > 0) disc(centre, scale * section.of.core, band);
  for (const part of section.parts) disc(part, scale * part.radius, part.plain ? rule : band, rule);
  section.wires.forEach((wire, k) => disc(wire, Math.max(scale * wire.radius, .6), css(sectionScale.colour(damages[k]))));
  if (larger) disc(larger, scale * larger.radius + 2 * ratio, null, ink, 2);
  if (marked) {
    const around = Math.max(scale * marked.radius + 3 * ratio, 6 * ratio);
    disc(marked, around, null, ground, 5);
    disc(marked, around, null, '#d32f00', 2.5);
  }
}

let sectionView = null;
function wireRows(row, section) {
  return row.worst.map(
      ([k, damage]) => make(
          'tr', {}, make('td', {}, section.wires[k].path), make('td', {class: 'number', 'data-value': damage}, readable(damage)),
          make('td', {class: 'number'}, readable(life.repeat_seconds / 3600 / damage))));
}
function showSection() {
  const place = document.getElementById('section');
  if (!place || !data.section || state.segment < 0) return;
  if (!sectionScale) prepareSections();
  const row = data.section.rows.find(one => one.segment === state.segment);
  if (!row) {
    place.replaceChildren(make('p', {class: 'soft'}, 'No wire is damaged here, or the page has no room for this place\u2019s wires.'));
    sectionView = null;
    return;
  }
  const section = crossSections[row.dresspack], damages = damagesOf(row, section.wires.length);
  const worst = row.worst.length ? section.wires[row.worst[0][0]] : null, hint = make('p', {class: 'soft', 'aria-live': 'polite'});
  let larger = section.nearPart(worst);
  const label = `Cross-section of ${placeWords(state.segment)}, worst ${worst ? worst.path : 'none'}`;
  const all = make('canvas', {role: 'img', 'aria-label': label}),
        near = make('canvas', {role: 'img', 'aria-label': `The same, larger around ${worst ? worst.path : 'its middle'}`});
  const draw = () => {
    drawCrossSection(all, section, damages, section.whole(), worst, larger);
    drawCrossSection(near, section, damages, larger, worst, null);
  };
  const under = (canvas, view, event) => {
    const size = canvas.getBoundingClientRect(), scale = 2.12 * view.radius / size.width;
    return [view.x + (event.clientX - size.left - size.width / 2) * scale, view.y - (event.clientY - size.top - size.height / 2) * scale];
  };
  const describe = (canvas, view) => event => {
    const at = under(canvas, view(), event), wire = section.at(...at, section.wires), part = wire || section.at(...at, section.parts);
    const damage = wire ? damages[section.wires.indexOf(wire)] : 0;
    hint.textContent = wire ? `${wire.path}: ${damage ? `about ${readable(damage, 2)} per repeat` : `less than ${readable(sectionScale.low, 2)}`}` :
                              part ? part.path : '\u00a0';
  };
  all.addEventListener('pointermove', describe(all, () => section.whole()));
  near.addEventListener('pointermove', describe(near, () => larger));
  all.addEventListener('click', event => {
    const part = section.at(...under(all, section.whole(), event), section.parts.filter(one => one.radius < .5 * section.of.radius && !one.plain));
    larger = part ? part.holders.find(one => one.radius < .5 * section.of.radius) || part : section.whole();
    draw();
  });
  hint.textContent = 'A click on the left shows a cable larger; the pointer names a wire.';
  place.replaceChildren(
      make('h2', {}, `Across ${placeWords(state.segment)}: every wire by its damage`),
      make(
          'div', {class: 'sections'}, make('figure', {}, all), make('figure', {}, near),
          make(
              'div', {}, make('div', {class: 'bar', style: `background:${sectionScale.gradient()}`}),
              make('div', {class: 'ends soft'}, ...[sectionScale.low, sectionScale.high].map(value => make('span', {}, readable(value, 2)))),
              make('p', {class: 'soft'}, 'Damage per repeat, grey: less. Ringed the worst wire; parts lie as at the base clamp.'),
              make(
                  'table', {}, make('thead', {}, make('tr', {}, make('th', {}, 'damaged most here'), make('th', {class: 'number'}, 'per repeat'), make('th', {class: 'number'}, 'life [h]'))),
                  make('tbody', {}, ...wireRows(row, section))),
              hint)));
  sectionView = {draw, row};
  draw();
}
function redrawSection() {
  if (sectionView) sectionView.draw();
}
