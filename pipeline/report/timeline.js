// Histories over time, one panel above the other: strain, damage, shape, joints and the program. A click or drag changes the
// time, the wheel zooms in time, a double click shows the whole time.
const jointColours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#8c6d1f', '#56b4e9', '#7b5ea7'];
const leftMargin = 64, rightMargin = 10, panelGap = 22, lineHeight = 15;

const labelFont = '12px system-ui, "Segoe UI", "DejaVu Sans", Arial, sans-serif';

class Timeline {
  // duration [s]; onTime(time): called when the reader chooses a time.
  constructor(place, duration, onTime) {
    this.canvas = document.createElement('canvas');
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', 'Histories over time; a click moves the time, the wheel zooms');
    this.hint = document.createElement('p');
    this.hint.className = 'soft hint';
    this.hint.textContent = 'Click or drag: go there. Wheel: zoom. Double click: all of it.';
    place.append(this.canvas, this.hint);
    Object.assign(this, {place, duration, onTime, panels: [], now: 0, from: 0, to: duration || 1});
    this.listen();
    new ResizeObserver(() => this.draw()).observe(place);
  }
  listen() {
    const timeOf = event => this.timeAt(event.clientX - this.canvas.getBoundingClientRect().left);
    let dragging = false;
    this.canvas.addEventListener('pointerdown', event => {
      dragging = true;
      this.canvas.setPointerCapture(event.pointerId);
      this.onTime(timeOf(event));
    });
    this.canvas.addEventListener('pointermove', event => {
      if (dragging) this.onTime(timeOf(event));
      else this.describe(timeOf(event));
    });
    this.canvas.addEventListener('pointerup', () => dragging = false);
    this.canvas.addEventListener('pointercancel', () => dragging = false);
    this.canvas.addEventListener('dblclick', () => this.zoom(0, this.duration));
    this.canvas.addEventListener('wheel', event => {
      event.preventDefault();
      const at = timeOf(event), factor = Math.exp(Math.sign(event.deltaY) * .25);
      this.zoom(at - (at - this.from) * factor, at + (this.to - at) * factor);
    }, {passive: false});
  }
  zoom(from, to) {
    const least = Math.min(.2, this.duration), span = Math.min(Math.max(to - from, least), this.duration);
    this.from = Math.min(Math.max(from, 0), this.duration - span);
    this.to = this.from + span;
    this.draw();
  }
  timeAt(x) {
    const part = (x - leftMargin) / (this.width - leftMargin - rightMargin);
    return Math.min(Math.max(this.from + part * (this.to - this.from), 0), this.duration);
  }
  xAt(time) { return leftMargin + (time - this.from) / (this.to - this.from) * (this.width - leftMargin - rightMargin); }
  moveTo(time) {
    this.now = time;
    if (time < this.from || time > this.to) this.zoom(time - (this.to - this.from) * .1, time + (this.to - this.from) * .9);
    else this.drawNow();
  }
  describe(time) {
    const words = this.panels.map(panel => panel.words && panel.words(time)).filter(Boolean);
    this.hint.textContent = `${time.toFixed(2)} s   ${words.join('   ')}`;
  }
  // panels: {title, brief (used if the title does not fit), height, low, high, curves: [{time, values, colour, name}] or
  // draw(context, panel), words(time)}
  setPanels(panels) {
    this.panels = panels;
    this.draw();
  }
  draw() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (!matchMedia('print').matches || !this.width) this.width = Math.max(this.place.clientWidth, 200);
    const context = this.canvas.getContext('2d');
    context.font = labelFont;
    for (const panel of this.panels) panel.lines = Math.max(0, ...this.namesOf(context, panel, this.titleOf(context, panel)).map(name => name.line));
    const height = this.panels.reduce((sum, panel) => sum + panel.height + panelGap + lineHeight * panel.lines, 22);
    this.canvas.style.height = `${height}px`;
    if (this.canvas.width !== Math.round(this.width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(this.width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    const style = getComputedStyle(document.documentElement);
    const colour = name => style.getPropertyValue(name).trim();
    this.colours = {
      ink: colour('--ink'),
      soft: colour('--soft'),
      grid: colour('--grid'),
      blue: colour('--blue'),
      hot: colour('--hot'),
      band: colour('--band'),
      band2: colour('--band-2'),
      page: colour('--page')
    };
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = this.colours.page;
    context.fillRect(0, 0, this.width, height);
    context.font = labelFont;
    let top = panelGap - 4;
    for (const panel of this.panels) {
      panel.top = top += lineHeight * panel.lines;
      this.drawPanel(context, panel);
      top += panel.height + panelGap;
    }
    this.drawTimes(context, top - panelGap);
    this.bottom = top - panelGap + 4;
    this.still = this.still || document.createElement('canvas');
    Object.assign(this.still, {width: this.canvas.width, height: this.canvas.height});
    this.still.getContext('2d').drawImage(this.canvas, 0, 0);
    this.drawNow();
  }
  // Redraws the stored picture of the histories, and a line at the chosen time.
  drawNow() {
    const context = this.canvas.getContext('2d'), ratio = Math.min(window.devicePixelRatio || 1, 2), x = this.xAt(this.now);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.still, 0, 0);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.strokeStyle = this.colours.ink;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(x, 4);
    context.lineTo(x, this.bottom);
    context.stroke();
  }
  yAt(panel, value) { return panel.top + panel.height * (1 - (value - panel.low) / (panel.high - panel.low || 1)); }

  titleOf(context, panel) {
    const fits = panel.brief === undefined || leftMargin + context.measureText(panel.title).width < this.width - rightMargin;
    return fits ? panel.title : panel.brief;
  }
  // Draws the legend behind the title, or on lines below it if the width is too small.
  namesOf(context, panel, title) {
    const names = [];
    let x = leftMargin + context.measureText(title).width + 14, line = 0;
    for (const curve of panel.curves || []) {
      if (!curve.name) continue;
      const wide = context.measureText(curve.name).width;
      if (x > leftMargin && x + 13 + wide > this.width - rightMargin) {
        x = leftMargin;
        ++line;
      }
      names.push({curve, x, line});
      x += wide + 24;
    }
    return names;
  }
  drawPanel(context, panel) {
    const right = this.width - rightMargin;
    context.fillStyle = this.colours.soft;
    context.textAlign = 'left';
    const title = this.titleOf(context, panel);
    context.fillText(title, leftMargin, panel.top - 5 - lineHeight * panel.lines);
    context.save();
    if (panel.low !== undefined) this.drawGrid(context, panel);
    context.beginPath();
    context.rect(leftMargin, panel.top - 1, right - leftMargin, panel.height + 2);
    context.clip();
    for (const curve of panel.curves || []) this.drawCurve(context, panel, curve);
    if (panel.draw) panel.draw(context, panel, this);
    context.restore();
    for (const {curve, x, line} of this.namesOf(context, panel, title)) {
      const y = panel.top - 5 - lineHeight * (panel.lines - line);
      context.fillStyle = curve.colour;
      context.fillRect(x, y - 6, 10, 3);
      context.fillStyle = this.colours.soft;
      context.fillText(curve.name, x + 13, y);
    }
  }
  drawGrid(context, panel) {
    const step = roundStep((panel.high - panel.low) / Math.max(panel.height / 24, 1));
    context.strokeStyle = this.colours.grid;
    context.lineWidth = 1;
    context.textAlign = 'right';
    for (let k = Math.ceil(panel.low / step); k * step <= panel.high * (1 + 1e-9); ++k) {
      const y = this.yAt(panel, k * step);
      context.beginPath();
      context.moveTo(leftMargin, y);
      context.lineTo(this.width - rightMargin, y);
      context.stroke();
      context.fillText(String(Number((k * step).toPrecision(6))), leftMargin - 5, y + 4);
    }
  }
  // Shows all extremes: the least and the largest of the samples under one pixel.
  drawCurve(context, panel, curve) {
    context.strokeStyle = curve.colour;
    context.lineWidth = 1.2;
    context.beginPath();
    let column = null, low = 0, high = 0, last = 0;
    const flush = () => {
      if (column === null) return;
      context.lineTo(column, this.yAt(panel, low));
      if (high > low) context.lineTo(column, this.yAt(panel, high));
      context.lineTo(column, this.yAt(panel, last));
    };
    const first = Math.max(lastNotAbove(curve.time, this.from), 0);
    for (let k = first; k < curve.time.length; ++k) {
      const x = Math.round(this.xAt(curve.time[k]) * 2) / 2, value = curve.values[k];
      if (x !== column) {
        flush();
        column = x;
        low = high = value;
        context.lineTo(x, this.yAt(panel, value));
      }
      low = Math.min(low, value);
      high = Math.max(high, value);
      last = value;
      if (curve.time[k] > this.to) break;
    }
    flush();
    context.stroke();
  }
  drawTimes(context, bottom) {
    const step = roundStep((this.to - this.from) / Math.max((this.width - leftMargin) / 90, 1));
    context.fillStyle = this.colours.soft;
    context.textAlign = 'center';
    for (let k = Math.ceil(this.from / step); k * step <= this.to; ++k)
      context.fillText(`${Number((k * step).toPrecision(6))} s`, this.xAt(k * step), bottom + 15);
  }
}

// Returns the smallest 1, 2 or 5 times a power of ten that is not below the value.
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least || 1));
  return [1, 2, 5, 10].map(factor => factor * power).find(step => step >= least * (1 - 1e-9));
}

function valueAt(time, values, at) {
  const k = lastNotAbove(time, at), next = Math.min(k + 1, time.length - 1);
  const part = time[next] > time[k] ? (at - time[k]) / (time[next] - time[k]) : 0;
  return values[k] + Math.min(Math.max(part, 0), 1) * (values[next] - values[k]);
}
