// The pure part of the page's charts; `node --test` runs it, see test/lint.
// claim: A long plot keeps its spikes; its labels tell marks apart
import assert from "node:assert/strict";
import { test } from "node:test";

import { Track, mark, rowsAgainst, rowsOf, rowsOfArrays } from "../../../common/cockpit/page/samples.js";

const sines = (count) => new Track(Array.from({ length: count }, (_, i) => [i / 50, Math.sin(i / 1000)]));

test("few samples are drawn as they are, those of two tracks at one time in one row", () => {
  const [a, b] = [new Track([[0, 1], [1, 2], [2, 3]]), new Track([[1, 7], [1.5, 8]])];
  assert.deepEqual(rowsOf([a, b], 0, 2, 100), [[0, 1, null], [1, 2, 7], [1.5, null, 8], [2, 3, null]]);
  assert.deepEqual(rowsOf([a], 0.9, 1.1, 100).map(([t]) => t), [0, 1, 2]); // lines reach both edges
});

test("of many samples each column has the extremes, in their order, and no spike is lost", () => {
  const track = sines(30000);
  track.values[15000] = 5;
  track.values[15001] = -5;
  const rows = rowsOf([track, new Track()], 0, 600, 1000);
  assert.equal(rows.length, 2000);
  const at = rows.findIndex(([, value]) => value === 5);
  assert.equal(rows[at + 1][1], -5);
  assert.ok(Math.abs(rows[at][0] - 300) < 0.6);
  assert.ok(rows.every(([t, , other], i) => other === null && (!i || t > rows[i - 1][0])));
});

test("the marks of an axis differ", () => {
  for (const [values, step, texts] of [
    [[0.09, 0.095, 0.1], 0.005, ["0.090", "0.095", "0.100"]],
    [[1763985012, 1763985014], 2, ["1763985012", "1763985014"]],
    [[0, 1e300, 2e300], 1e300, ["0", "1.0e+300", "2.0e+300"]],
    [[0, 2e-9], 1e-9, ["0", "2.0e-9"]],
  ]) assert.deepEqual(values.map((value) => mark(value, step)), texts);
});

test("against another track each of its times in the window is a row, at most so many", () => {
  const [x, y] = [new Track([[0, 5], [1, 6], [2, 4], [3, 9]]), new Track([[0, 1], [1.5, 2], [2, 3]])];
  assert.deepEqual(rowsAgainst(x, [y, new Track()], 1, 2, 100), [[6, 1, null], [4, 3, null]]);
  assert.deepEqual(rowsAgainst(x, [y], 0, 3, 2).map(([value]) => value), [5, 4]);
  assert.deepEqual(rowsAgainst(new Track(), [y], 0, 3, 2), []);
});

test("arrays are rows by index, with a gap where one is shorter", () => {
  const array = (entries) => Object.assign(new Track(), { entries });
  const [one, none, other, level] = [array([1, null]), array([]), array([7]), new Track([[0, 3], [1, 4]])];
  assert.deepEqual(rowsOfArrays([one, none, other, level]), [[0, 1, null, 7, 4], [1, null, null, null, 4]]);
});
