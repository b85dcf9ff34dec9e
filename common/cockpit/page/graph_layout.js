/** Where nodes and topics are drawn: in layers from left to right, in the direction of the arrows. */

import { byName } from "./dom.js";

const SIZE = { height: 34, letter: 7.2, padding: 24, between: 16, bend: 6, layers: 56, tip: 12, margin: 12, title: 24 };
const ROWS = 14; // of boxes in a column; a layer with more has several columns, and is about as wide as high
const FAR = 100; // rows between two bands, of which the lower one attracts to the bottom
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }; // to the right, down
const BEND = "bend "; // of a long arrow: a place in each column between, where no box may be

/** Of edges: before, the items that lead to an item, by its name; after, those to which it leads. */
export function neighbours(edges) {
  const found = { before: {}, after: {} };
  for (const { from, to } of edges) {
    (found.before[to] ??= []).push(from);
    (found.after[from] ??= []).push(to);
  }
  return found;
}

/**
 * items: names such as "node /a" and "topic /b". edges: [{from, to}]. groups: {item: the name of its group}.
 * Returns {width, height, boxes: {item: {x, y, w, h}}, arrows: [{from, to, path}], groups: [{name, items, x, y, w, h}]}
 * in pixels.
 */
export function layout(items, edges, groups = {}) {
  const there = new Set(items);
  const known = edges.filter(({ from, to }) => there.has(from) && there.has(to));
  // Band 0 has the items without a group; each group is a band of its own, across all columns.
  const names = ["", ...[...new Set(Object.values(groups))].sort(byName)];
  const bands = new Map(items.map((item) => [item, names.indexOf(groups[item] ?? "")]));
  const columns = split(layers(items, known), bands);
  const columnOf = {};
  columns.forEach((column, i) => column.forEach((item) => (columnOf[item] = i)));
  const near = new Map(); // item -> its neighbours in the columns beside its own
  const ways = known.map((edge) => wayOf(edge, columnOf, columns, near, bands));
  untangle(columns, near, bands);
  const { width, height, boxes, sides, tops } = place(columns, bands);
  const arrows = known.map((edge, i) => {
    const points = ways[i].flatMap((item, k) => stops(boxes[item], sides[columnOf[ways[i][0]] + k]));
    const ahead = columnOf[edge.from] < columnOf[edge.to];
    return { ...edge, path: curve(ahead ? points : points.reverse(), ahead ? -3 : 3) };
  });
  return { width, height, boxes: Object.fromEntries(items.map((item) => [item, boxes[item]])), arrows,
    groups: byBand(items, bands).slice(1).map((own, i) => outline(names[i + 1], own, boxes, tops[i + 1], tops[i + 2])) };
}

/** The items of each band. */
function byBand(items, bands) {
  const parts = Array.from({ length: 1 + Math.max(...bands.values()) }, () => []);
  for (const item of items) parts[bands.get(item)].push(item);
  return parts;
}

/** Each layer as columns in which a band has about the same number of rows, by name. */
function split(layers, bands) {
  return layers.flatMap((layer) => {
    const parts = byBand(layer.sort(byName), bands);
    const countOf = ({ length }) => Math.ceil(length / Math.max(ROWS, Math.sqrt(4 * length)));
    const count = Math.max(...parts.map(countOf));
    return Array.from({ length: count }, (_, i) => parts.flatMap((part) => {
      const rows = Math.ceil(part.length / count);
      return part.slice(i * rows, (i + 1) * rows);
    }));
  });
}

/**
 * The items of an arrow from left to right, with a bend in each column that it passes. All arrows of a
 * node in one direction share their bends, as otherwise 2,000 topics would need as many rows.
 */
function wayOf({ from, to }, columnOf, columns, near, bands) {
  const [left, right] = columnOf[from] < columnOf[to] ? [from, to] : [to, from];
  const isAfter = left.startsWith("node ");
  const line = isAfter ? `after ${left}` : `before ${right}`;
  const way = [left];
  for (let i = columnOf[left] + 1; i < columnOf[right]; i += 1) {
    way.push(`${BEND}${line} ${i}`);
    if (!near.has(way.at(-1))) columns[i].push(way.at(-1));
    bands.set(way.at(-1), bands.get(isAfter ? left : right));
  }
  way.push(right);
  const connect = (item, other, isWanted) => {
    if (isWanted || !item.startsWith(BEND)) near.set(item, (near.get(item) ?? new Set()).add(other));
  };
  way.slice(1).forEach((item, i) => { // A bend only follows its node, so that the line is straight.
    connect(item, way[i], isAfter);
    connect(way[i], item, !isAfter);
  });
  return way;
}

/** Both ends of what an arrow passes, extended to the sides of its column, so that no box hides a bend. */
function stops({ x, y, w, h }, [left, right]) {
  return [[left, y + h / 2], [x, y + h / 2], [x + w, y + h / 2], [right, y + h / 2]];
}

/** An SVG path along the stops at boxes, to the right or to the left. tip: room for the arrowhead. */
function curve(stopped, tip) {
  const points = stopped.slice(2, -2); // from the far side of the first box to the near side of the last
  points[points.length - 1] = [points.at(-1)[0] + tip, points.at(-1)[1]];
  const corners = points.filter(([, y], i) => y !== points[i - 1]?.[1] || y !== points[i + 1]?.[1]);
  return corners.reduce((path, [x, y], i) => {
    if (!i) return `M${x} ${y}`;
    const [px, py] = corners[i - 1];
    const middle = (px + x) / 2;
    return py === y ? `${path} H${x}` : `${path} C${middle} ${py} ${middle} ${y} ${x} ${y}`;
  }, "");
}

/** An item is one layer after the last item that leads to it; an arrow that closes a loop is ignored. */
function layers(items, edges) {
  const { before, after } = neighbours(edges);
  const seen = new Set();
  const order = []; // each item after those that follow it
  const visit = (item) => {
    if (seen.has(item)) return;
    seen.add(item);
    after[item]?.forEach(visit);
    order.push(item);
  };
  [...items.filter((item) => !before[item]), ...items].forEach(visit);
  const layer = {};
  const found = [];
  for (const item of order.reverse()) {
    layer[item] = 1 + Math.max(-1, ...(before[item] ?? []).map((one) => layer[one] ?? -1));
    (found[layer[item]] ??= []).push(item);
  }
  return found;
}

/** Order each band of a column by the mean place of its neighbours, a few times, so that few arrows cross. */
function untangle(columns, near, bands) {
  const place = {};
  const note = (column) => byBand(column, bands).forEach((own) =>
    own.forEach((item, i) => (place[item] = i - own.length / 2)));
  const mean = (item) => {
    const others = [...(near.get(item) ?? [])];
    const below = (other) => place[other] + FAR * (bands.get(other) - bands.get(item));
    const found = others.reduce((sum, other) => sum + below(other) / others.length, 0);
    return item.startsWith(BEND) ? found + Math.sign(found) : found; // farther out than the item to which the line leads
  };
  columns.forEach(note);
  for (let turn = 0; turn < 6; turn += 1) {
    for (const column of columns) {
      const means = Object.fromEntries(column.map((item) => [item, mean(item)]));
      column.sort((a, b) => means[a] - means[b]);
      note(column);
    }
  }
}

/** The boxes, the left and right side of each column, and where the bands begin, with the end of the last one. */
function place(columns, bands) {
  const isBend = (item) => item.startsWith(BEND);
  const rowOf = (item) => (isBend(item) ? SIZE.bend : SIZE.height + SIZE.between);
  const heightOf = (items) => items.reduce((sum, item) => sum + rowOf(item), 0);
  const parts = columns.map((column) => byBand(column, bands));
  const titleOf = (band) => (band ? SIZE.title : 0);
  const tops = [SIZE.margin];
  parts[0]?.forEach((_, band) =>
    tops.push(tops[band] + titleOf(band) + Math.max(...parts.map((part) => heightOf(part[band])))));
  const [boxes, sides] = [{}, []];
  let x = SIZE.margin;
  const widthOf = (item) => Math.round((item.length - item.indexOf(" ") - 1) * SIZE.letter + SIZE.padding);
  columns.forEach((column, i) => {
    const w = column.reduce((most, item) => (isBend(item) ? most : Math.max(most, widthOf(item))), 0);
    parts[i].forEach((part, band) => {
      let y = Math.round((tops[band] + titleOf(band) + tops[band + 1] - heightOf(part)) / 2);
      for (const item of part) {
        const own = widthOf(item);
        boxes[item] = isBend(item) ? { x, y, w, h: 0 }
          : { x: x + (w - own) / 2, y: y + SIZE.between / 2, w: own, h: SIZE.height };
        y += rowOf(item);
      }
    });
    sides.push([x - SIZE.tip, x + w + SIZE.tip]); // heads of arrows are between
    x += w + SIZE.layers;
  });
  const width = Math.max(x - SIZE.layers + SIZE.margin, 100);
  return { width, height: tops.at(-1) + SIZE.margin, boxes, sides, tops };
}

/** The outline of a group, from the top of their band to that of the next one. */
function outline(name, items, boxes, top, next) {
  const y = top + SIZE.between / 2;
  const x = Math.min(...items.map((item) => boxes[item].x)) - SIZE.tip;
  const right = Math.max(...items.map((item) => boxes[item].x + boxes[item].w)) + SIZE.tip;
  return { name, items, x, y, w: right - x, h: next - y };
}

/** The item above or below another one in its column, or in the column beside it; undefined if none is there. */
export function itemBeside(boxes, item, key) {
  const [side, down] = ARROWS[key] ?? [0, 0];
  const columnOf = ({ x, w }) => x + w / 2;
  const steps = Object.entries(boxes).map(([name, box]) =>
    ({ name, dx: columnOf(box) - columnOf(boxes[item]), dy: box.y - boxes[item].y }));
  const ahead = steps.filter(({ dx, dy }) => (side ? dx * side > 0 : dx === 0 && dy * down > 0));
  return ahead.sort((a, b) => Math.abs(a.dx) - Math.abs(b.dx) || Math.abs(a.dy) - Math.abs(b.dy))[0]?.name;
}
