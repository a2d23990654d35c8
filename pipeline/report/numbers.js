// The page's data: rows of numbers from base64, and interpolation of a motion between its key samples.
function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}
const wholeNumbers = base64 => new Uint16Array(bytesOf(base64));
const floats = base64 => new Float32Array(bytesOf(base64));

// Returns the index of the last entry of a rising list that is at most the value; 0 if no entry is.
function lastNotAbove(list, value) {
  let low = 0, high = list.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (list[middle] <= value) low = middle;
    else high = middle - 1;
  }
  return low;
}

// Returns "1,230", "4.56", "7.8e-9": about three figures, as in the tables of the report.
function readable(value, figures = 3) {
  if (value === null || value === undefined || Number.isNaN(value)) return '-';
  const size = Math.abs(value);
  if (size === 0) return '0';
  if (size >= 1e10 || size < 1e-3) return value.toExponential(figures - 1);
  if (size >= 10 ** figures) return Number(value.toPrecision(figures)).toLocaleString('en-US');
  return String(Number(value.toPrecision(figures)));
}

class Motion {
  constructor(data) {
    this.data = data;
    this.time = floats(data.time);
    for (const group of Object.values(data.groups))
      group.values = group.narrow ? new Uint8Array(bytesOf(group.numbers)) : wholeNumbers(group.numbers);
    this.duration = data.end - data.begin;
    this.row = new Float64Array(data.width);
  }
  group(name) { return this.data.groups[name] || null; }

  // Fills `row` with all quantities at this time after the begin of the motion [s], by linear interpolation.
  goTo(time) {
    const last = this.time.length - 1;
    const k = Math.min(lastNotAbove(this.time, time), Math.max(last - 1, 0)), next = Math.min(k + 1, last);
    const lasts = this.time[next] - this.time[k];
    const part = lasts > 0 ? Math.min(Math.max((time - this.time[k]) / lasts, 0), 1) : 0;
    for (const group of Object.values(this.data.groups))
      for (let q = 0; q < group.size; ++q) {
        const before = group.values[k * group.size + q], after = group.values[next * group.size + q];
        this.row[group.begin + q] = group.low + group.step * (before + part * (after - before));
      }
    return this.row;
  }
  // Returns one quantity at all key samples.
  history(name, index) {
    const group = this.group(name), values = new Float64Array(this.time.length);
    for (let k = 0; k < values.length; ++k) values[k] = group.low + group.step * group.values[k * group.size + index];
    return values;
  }
  // Returns the least and the largest value of a group over the whole motion.
  range(name) {
    const group = this.group(name);
    return [group.low, group.high];
  }
}
