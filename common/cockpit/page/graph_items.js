/** What the tab Graph draws of a graph, in which groups, and the same in DOT, the language of graphviz. */

// What serves debugging, by and large as in rqt_graph: all nodes are connected to it, which would hide the rest.
const DEBUG = /\/(rosout(_agg)?|statistics|clock|diagnostics(_agg)?|parameter_(updates|descriptions)|(rqt|rviz)\w*|record_\d+)$/;

/** The items "node /a" and "topic /b"; hidden: "debug", "sinks" (topics without a subscriber), "sources". */
export function itemsOf({ nodes, topics, edges }, hidden) {
  const isDebug = (item) => hidden.includes("debug") && DEBUG.test(item);
  const drawn = edges.filter(({ from, to }) => !isDebug(from) && !isDebug(to));
  const subscribed = new Set(drawn.map(({ from }) => from));
  const published = new Set(drawn.map(({ to }) => to));
  const isWhole = (topic) => (subscribed.has(topic) || !hidden.includes("sinks"))
    && (published.has(topic) || !hidden.includes("sources"));
  const items = topics.map(({ name }) => `topic ${name}`).filter(isWhole);
  return [...nodes.map(({ name }) => `node ${name}`), ...items].filter((item) => !isDebug(item));
}

/** {item: its group}, the first part of its name, if that is a namespace that another item has, too. */
export function groupsOf(items) {
  const inside = {};
  for (const item of items) (inside[`/${item.split("/")[1]}`] ??= []).push(item);
  const isDeep = (item) => item.split("/").length > 2;
  const groups = Object.entries(inside).filter(([, own]) => own.length > 1 && own.some(isDeep));
  return Object.fromEntries(groups.flatMap(([group, own]) => own.map((item) => [item, group])));
}

/** boxes, arrows and groups as layout() returns them. */
export function dotOf({ boxes, arrows, groups }) {
  const quoted = (text) => JSON.stringify(text);
  const isNode = (item) => item.startsWith("node ");
  const lines = [
    ...Object.keys(boxes).map((item) =>
      `${quoted(item)} [label=${quoted(item.slice(item.indexOf(" ") + 1))} shape=${isNode(item) ? "ellipse" : "box"}]`),
    ...groups.map(({ name, items }) =>
      `subgraph ${quoted(`cluster ${name}`)} { label=${quoted(name)} ${items.map(quoted).join(" ")} }`),
    ...arrows.map(({ from, to }) => `${quoted(from)} -> ${quoted(to)}`),
  ];
  return `digraph ros {\n  rankdir=LR\n${lines.map((line) => `  ${line}\n`).join("")}}\n`;
}
