/** Where nodes and topics are drawn: in layers from left to right, as arrows go (pure). */

const SIZE = { height: 34, letter: 7.6, padding: 26, between: 16, layers: 60, margin: 12 };

/**
 * items: names such as "node /a" and "topic /b". edges: [{from, to}].
 * Returns {width, height, boxes: {name: {x, y, w, h}}, arrows: [{from, to, path}]} in pixels.
 */
export function layout(items, edges) {
  const known = edges.filter(({ from, to }) => items.includes(from) && items.includes(to));
  const layerOf = layers(items, known);
  const columns = [];
  for (const item of items) (columns[layerOf[item]] ??= []).push(item);
  untangle(columns, known);
  return place(columns, known);
}

/** Each item one layer after the last of those that lead to it; of a loop, the way back does not count. */
function layers(items, edges) {
  const after = Object.fromEntries(items.map((item) => [item, []]));
  for (const { from, to } of edges) after[from].push(to);
  const order = [];
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
  const isReached = new Set(edges.map(({ to }) => to));
  const starts = items.filter((item) => !isReached.has(item));
  for (const item of [...starts, ...items]) if (!state[item]) visit(item);
  const layer = Object.fromEntries(items.map((item) => [item, 0]));
  for (const item of order) {
    for (const next of after[item]) {
      if (!back.has(`${item}>${next}`)) layer[next] = Math.max(layer[next], layer[item] + 1);
    }
  }
  return layer;
}

/** Order each column by the mean place of its neighbours, a few times, so that few arrows cross. */
function untangle(columns, edges) {
  for (let turn = 0; turn < 6; turn += 1) {
    const place = {};
    for (const column of columns) column.forEach((item, i) => (place[item] = i - column.length / 2));
    for (const column of columns) {
      const mean = (item) => {
        const near = edges.flatMap(({ from, to }) => (from === item ? [to] : to === item ? [from] : []));
        return near.length ? near.reduce((sum, other) => sum + place[other], 0) / near.length : 0;
      };
      const means = Object.fromEntries(column.map((item) => [item, mean(item)]));
      column.sort((a, b) => means[a] - means[b] || (a < b ? -1 : 1));
      column.forEach((item, i) => (place[item] = i - column.length / 2));
    }
  }
}

function place(columns, edges) {
  const step = SIZE.height + SIZE.between;
  const tallest = Math.max(1, ...columns.map((column) => column.length));
  const boxes = {};
  let x = SIZE.margin;
  for (const column of columns) {
    const name = (item) => item.slice(item.indexOf(" ") + 1);
    const w = Math.max(...column.map((item) => name(item).length)) * SIZE.letter + SIZE.padding;
    const top = SIZE.margin + ((tallest - column.length) * step) / 2;
    column.forEach((item, i) => {
      const own = name(item).length * SIZE.letter + SIZE.padding;
      boxes[item] = { x: x + (w - own) / 2, y: top + i * step, w: own, h: SIZE.height };
    });
    x += w + SIZE.layers;
  }
  const arrows = edges.map(({ from, to }) => {
    const [a, b] = [boxes[from], boxes[to]];
    const [x1, y1, x2, y2] = [a.x + a.w, a.y + a.h / 2, b.x - 3, b.y + b.h / 2];
    const bend = x2 > x1 ? (x2 - x1) / 2 : 70; // a way back leaves to the right and comes from the left
    return { from, to, path: `M${x1} ${y1} C${x1 + bend} ${y1} ${x2 - bend} ${y2} ${x2} ${y2}` };
  });
  const width = Math.max(x - SIZE.layers + SIZE.margin, 100);
  return { width, height: tallest * step + SIZE.margin, boxes, arrows };
}
