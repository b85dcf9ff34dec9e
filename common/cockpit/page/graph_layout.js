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

/** An SVG path along boxes, whichever way they follow each other. */
function curve(boxes) {
  const ahead = boxes.at(-1).x > boxes[0].x;
  const points = boxes.flatMap(({ x, y, w, h }, i) => {
    const [near, far] = ahead ? [x, x + w] : [x + w, x];
    const tip = ahead ? -3 : 3;
    const ends = [[near + (i === boxes.length - 1 ? tip : 0), y + h / 2], [far, y + h / 2]];
    return i === 0 ? [ends[1]] : i === boxes.length - 1 ? [ends[0]] : ends;
  });
  let path = `M${points[0]}`;
  for (let i = 1; i < points.length; i += 1) {
    const middle = (points[i - 1][0] + points[i][0]) / 2;
    path += ` C${middle} ${points[i - 1][1]} ${middle} ${points[i][1]} ${points[i]}`;
  }
  return path;
}

/** Each item one layer after the last of those that lead to it; in a loop, the way back does not count. */
function layers(items, edges) {
  const after = Object.fromEntries(items.map((item) => [item, []]));
  for (const { from, to } of edges) after[from].push(to);
  const order = []; // each item before those that follow it
  const state = {};
  const back = new Set();
  const visit = (item) => {
    state[item] = "open";
    for (const next of after[item]) {
      if (state[next] === "open") back.add(`${item}>${next}`);
      else if (!state[next]) visit(next);
    }
    state[item] = "done";
    order.unshift(item);
  };
  const reached = new Set(edges.map(({ to }) => to));
  const starts = items.filter((item) => !reached.has(item));
  for (const item of [...starts, ...items]) if (!state[item]) visit(item);
  const layer = Object.fromEntries(items.map((item) => [item, 0]));
  for (const item of order) {
    for (const next of after[item].filter((one) => !back.has(`${item}>${one}`))) {
      layer[next] = Math.max(layer[next], layer[item] + 1);
    }
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
