/** Samples of numbers over time: kept, thinned for a chart, and as text. */

export const MOST = 120000; // samples of a field: ten minutes at 200 Hz
const DENSE = 4; // With this many samples a column of the chart shows its extremes only.

/** The index of the first of these ascending times that is not before t. */
export function firstAt(times, t) {
  let [low, high] = [0, times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] < t) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** The samples of one field. */
export class Track {
  times = []; // [s]
  values = [];
  entries = null; // the newest values of a whole array

  /** points: [[t, value], ...]. */
  constructor(points = []) {
    for (const [t, value] of points) this.push(t, value);
  }

  get newest() {
    return this.times.at(-1) ?? -Infinity;
  }

  push(t, value) {
    this.times.push(t);
    this.values.push(value);
  }

  /** Forget samples before a time and beyond MOST; many at once, as the others have to be moved. */
  forget(oldest) {
    const first = Math.max(firstAt(this.times, oldest), this.times.length - MOST);
    if (first < 1000 && first < this.times.length) return;
    this.times.splice(0, first);
    this.values.splice(0, first);
  }

  clear() {
    this.times.length = this.values.length = 0;
  }

  /** The value at a time, of the newest sample until then, or undefined. */
  at(t) {
    const i = firstAt(this.times, t);
    return this.values[this.times[i] === t ? i : i - 1];
  }
}

/**
 * Rows [t, value or null of each track] from one time to another, in their order. Where a column of the
 * chart would have many samples, it gets the smallest and the largest, so that no spike is lost.
 */
export function rowsOf(tracks, from, to, columns) {
  const spans = tracks.map(({ times }) => [Math.max(0, firstAt(times, from) - 1), firstAt(times, to) + 1]);
  const most = Math.max(0, ...spans.map(([first, end], i) => Math.min(end, tracks[i].times.length) - first));
  return most > DENSE * columns ? thinned(tracks, spans, (to - from) / columns) : joined(tracks, spans);
}

function joined(tracks, spans) {
  const rows = new Map();
  tracks.forEach(({ times, values }, i) => {
    for (let at = spans[i][0]; at < Math.min(spans[i][1], times.length); at++) {
      if (!rows.has(times[at])) rows.set(times[at], [times[at], ...tracks.map(() => null)]);
      rows.get(times[at])[i + 1] = values[at];
    }
  });
  return [...rows.values()].sort((a, b) => a[0] - b[0]);
}

/** width: of a column [s]; columns begin at its multiples, so that the curve moves without flickering. */
function thinned(tracks, spans, width) {
  const columns = new Map(); // number -> its two rows: the earlier and the later extreme
  const empty = tracks.map(() => null);
  tracks.forEach(({ times, values }, track) => {
    const [i, end] = [track + 1, Math.min(spans[track][1], times.length)];
    for (let at = spans[track][0]; at < end; at++) {
      const [number, value] = [Math.floor(times[at] / width), values[at]];
      let rows = columns.get(number);
      if (!rows) columns.set(number, (rows = [0.25, 0.75].map((part) => [(number + part) * width, ...empty])));
      const [first, second] = rows;
      if (first[i] === null) first[i] = second[i] = value;
      else if (value < Math.min(first[i], second[i])) [first[i], second[i]] = [Math.max(first[i], second[i]), value];
      else if (value > Math.max(first[i], second[i])) [first[i], second[i]] = [Math.min(first[i], second[i]), value];
    }
  });
  return [...columns.keys()].sort((a, b) => a - b).flatMap((number) => columns.get(number));
}

/** Rows [value of x, value of each track] at the times of x, a Track, between two times; at most so many. */
export function rowsAgainst(x, tracks, from, to, most) {
  const [first, end] = [from, to].map((t) => firstAt(x.times, t));
  const step = Math.ceil((end - first) / most);
  return x.times.slice(first, end + 1)
    .map((t, i) => [x.values[first + i], ...tracks.map((track) => track.at(t) ?? null)])
    .filter((_, i) => i % step === 0);
}

/** Rows [index, entry of each whole array; the newest value of each other field], of Tracks. */
export function rowsOfArrays(tracks) {
  const length = Math.max(0, ...tracks.map(({ entries }) => entries?.length ?? 0));
  const levels = tracks.map(({ values }) => values.at(-1) ?? null);
  return Array.from({ length }, (_, i) =>
    [i, ...tracks.map(({ entries }, track) => (entries ? entries[i] ?? null : levels[track]))]);
}

/** A number for a person: at most six digits, except seconds since 1970, with thousandths. */
export function written(value) {
  const size = Math.abs(value);
  return String(Number(size >= 1e5 && size < 1e15 ? value.toFixed(3) : value.toPrecision(6)));
}

/** The label of a mark on an axis whose marks are at least a step apart: as many digits as tell them apart. */
export function mark(value, step) {
  if (value === 0) return "0";
  const largest = Math.abs(value);
  const digits = Math.max(0, Math.ceil(-Math.log10(step)));
  if (largest < 1e11 && digits <= 6) return value.toFixed(digits);
  return value.toPrecision(Math.min(15, Math.max(2, Math.ceil(Math.log10(largest / step)) + 1)));
}
