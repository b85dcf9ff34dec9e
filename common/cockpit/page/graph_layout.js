/** Where nodes and topics are drawn: in layers from left to right, as arrows go (pure). */

const SIZE = { height: 34, letter: 7.2, padding: 24, between: 16, layers: 40, margin: 12 };
const BEND = "bend "; // of a long arrow: a place in each layer between, where no box may be

/**
 * items: names such as "node /a" and "topic /b". edges: [{from, to}].
 * Returns {width, height, boxes: {name: {x, y, w, h}}, arrows: [{from, to, path}]} in pixels.
 */
export function layout(items, edges) {
  const known = edges.filter(({ from, to }) => items.includes(from) && items.includes(to));
  const layerOf = layers(items, known);
  const columns = [];
  for (const item of items) (columns[layerOf[item]] ??= []).push(item);
  const ways = known.map((edge, i) => wayOf(edge, i, layerOf, columns));
  const steps = ways.flatMap((way) => way.slice(1).map((to, i) => ({ from: way[i], to })));
  untangle(columns, steps);
  const { width, height, boxes } = place(columns);
  const arrows = known.map((edge, i) => {
    const way = layerOf[edge.from] < layerOf[edge.to] ? ways[i] : ways[i].reverse();
    return { ...edge, path: curve(way.map((item) => boxes[item])) };
  });
  return { width, height, boxes: Object.fromEntries(items.map((item) => [item, boxes[item]])), arrows };
}

/** The items of an arrow from left to right, with a bend in each layer that it passes. */
function wayOf({ from, to }, number, layerOf, columns) {
  const [left, right] = layerOf[from] < layerOf[to] ? [from, to] : [to, from];
  const bends = [];
  for (let layer = layerOf[left] + 1; layer < layerOf[right]; layer += 1) {
    bends.push(`${BEND}${number} ${layer}`);
    columns[layer].push(bends.at(-1));
  }
  return [left, ...bends, right];
}

/** An SVG path along boxes, to the right or to the left. */
function curve(boxes) {
  const ahead = boxes.at(-1).x > boxes[0].x;
  const sides = boxes.flatMap(({ x, y, w, h }) => {
    const [left, right] = [[x, y + h / 2], [x + w, y + h / 2]];
    return ahead ? [left, right] : [right, left];
  });
  const points = sides.slice(1, -1); // from the far side of the first box to the near side of the last
  points.at(-1)[0] += ahead ? -3 : 3; // for the tip
  let path = `M${points[0]}`;
  for (let i = 1; i < points.length; i += 1) {
    const middle = (points[i - 1][0] + points[i][0]) / 2;
    path += ` C${middle} ${points[i - 1][1]} ${middle} ${points[i][1]} ${points[i]}`;
  }
  return path;
}

/** Each item one layer after the last of those that lead to it; an arrow that closes a loop does not count. */
function layers(items, edges) {
  const reached = new Set(edges.map(({ to }) => to));
  const starts = items.filter((item) => !reached.has(item));
  const seen = new Set();
  const order = []; // each item before those that follow it
  const visit = (item) => {
    if (seen.has(item)) return;
    seen.add(item);
    for (const { from, to } of edges) if (from === item) visit(to);
    order.unshift(item);
  };
  for (const item of [...starts, ...items]) visit(item);
  const layer = {};
  for (const item of order) {
    const before = edges.filter(({ from, to }) => to === item && from in layer);
    layer[item] = 1 + Math.max(-1, ...before.map(({ from }) => layer[from]));
  }
  return layer;
}

/** Order each column by the mean place of its neighbours, a few times, so that few arrows cross. */
function untangle(columns, edges) {
  const place = {};
  const note = (column) => column.forEach((item, i) => (place[item] = i - column.length / 2));
  const mean = (item) => {
    const near = edges.flatMap(({ from, to }) => (from === item ? [to] : to === item ? [from] : []));
    return near.length ? near.reduce((sum, other) => sum + place[other], 0) / near.length : 0;
  };
  columns.forEach(note);
  for (let turn = 0; turn < 6; turn += 1) {
    for (const column of columns) {
      const means = Object.fromEntries(column.map((item) => [item, mean(item)]));
      column.sort((a, b) => means[a] - means[b] || (a < b ? -1 : 1));
      note(column);
    }
  }
}

function place(columns) {
  const step = SIZE.height + SIZE.between;
  const tallest = Math.max(1, ...columns.map((column) => column.length));
  const boxes = {};
  let x = SIZE.margin;
  for (const column of columns) {
    const widths = column.map((item) =>
      item.startsWith(BEND) ? 0 : (item.length - item.indexOf(" ") - 1) * SIZE.letter + SIZE.padding);
    const w = Math.max(...widths);
    const top = SIZE.margin + ((tallest - column.length) * step) / 2;
    column.forEach((item, i) => {
      // A bend is as wide as its layer, so that the arrow is straight where boxes are.
      const own = widths[i] || w;
      boxes[item] = { x: x + (w - own) / 2, y: top + i * step, w: own, h: SIZE.height };
    });
    x += w + SIZE.layers;
  }
  const width = Math.max(x - SIZE.layers + SIZE.margin, 100);
  return { width, height: tallest * step + SIZE.margin, boxes };
}
