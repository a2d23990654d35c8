// Colours for numbers, distinct for colour-blind readers: plasma from dark to bright for amounts, blue to orange for values of
// both signs.
const sequentialStops = [[59, 4, 154], [126, 3, 168], [182, 48, 139], [225, 100, 98], [248, 149, 64], [252, 194, 50]];
const divergingStops = [[0, 82, 155], [90, 155, 205], [225, 225, 225], [240, 160, 70], [175, 80, 0]];
const noAmount = [150, 158, 168];

function colourOf(stops, part) {
  const place = Math.min(Math.max(part, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(place), stops.length - 2);
  return stops[k].map((value, i) => value + (place - k) * (stops[k + 1][i] - value));
}
const css = colour => `rgb(${colour.map(Math.round).join(',')})`;

// Colour of a quantity of segments: part(value) in 0 .. 1, null without a value.
class Scale {
  constructor(title, stops, low, high, logarithmic) { Object.assign(this, {title, stops, low, high, logarithmic}); }
  colour(value) {
    if (this.logarithmic && !(value > 0)) return noAmount;
    const part = this.logarithmic ? Math.log(value / this.low) / Math.log(this.high / this.low) :
                                    (value - this.low) / (this.high - this.low || 1);
    return colourOf(this.stops, part);
  }
  middle() { return this.logarithmic ? Math.sqrt(this.low * this.high) : (this.low + this.high) / 2; }
  gradient() { return `linear-gradient(to right, ${this.stops.map(css).join(', ')})`; }
}
