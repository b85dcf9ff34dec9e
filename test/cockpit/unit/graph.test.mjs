// What the graph draws, and where; the same in DOT.
// claim: Graph: groups of namespaces have their boxes and no others; what is hidden; where arrow keys lead
import assert from "node:assert/strict";
import { test } from "node:test";

import { dotOf, groupsOf, itemsOf } from "../../../common/cockpit/page/graph_items.js";
import { itemBeside, layout } from "../../../common/cockpit/page/graph_layout.js";

const named = (...names) => names.map((name) => ({ name }));
const to = (from, ...targets) => targets.map((target) => ({ from, to: target }));

test("a topic without a subscriber, one without a publisher, and debugging can be hidden", () => {
  const graph = {
    nodes: named("/a", "/b", "/rosout", "/robot/rviz_1", "/record_17", "/recorder"),
    topics: named("/heard", "/unheard", "/recorded", "/awaited", "/rosout", "/diagnostics"),
    edges: [
      ...to("node /a", "topic /heard", "topic /unheard", "topic /recorded", "topic /rosout", "topic /diagnostics"),
      ...to("topic /heard", "node /b"), ...to("topic /awaited", "node /b"), ...to("topic /rosout", "node /rosout"),
      ...to("topic /recorded", "node /record_17"),
    ],
  };
  const drawn = (...hidden) => itemsOf(graph, hidden).map((item) => item.split(" ")[1]);
  assert.equal(drawn().length, 12);
  const rest = ["/a", "/b", "/recorder", "/heard"];
  assert.deepEqual(drawn("debug"), [...rest, "/unheard", "/recorded", "/awaited"]);
  assert.deepEqual(drawn("debug", "sources"), [...rest, "/unheard", "/recorded"]);
  assert.deepEqual(drawn("debug", "sinks"), [...rest, "/awaited"]); // a recording is no subscriber that one sees
  assert.ok(drawn("sinks").includes("/recorded"));
});

/** A class: two topics and two nodes of each robot, with an arrow over two columns; nodes without a namespace. */
function room(robots) {
  const items = ["node /joy_node", "node /watch"];
  const edges = [];
  for (let i = 1; i <= robots; i += 1) {
    const [joy, odom] = ["joy", "odom"].map((name) => `topic /robot_${i}/${name}`);
    const [teleop, sim] = ["teleop", "sim"].map((name) => `node /robot_${i}/${name}`);
    items.push(joy, odom, teleop, sim);
    edges.push(...to("node /joy_node", joy), ...to(joy, teleop, sim), ...to(teleop, odom), ...to(odom, sim, "node /watch"));
  }
  return layout(items, edges, groupsOf(items));
}

for (const robots of [0, 1, 3, 30]) {
  test(`${robots} robots: each group has the boxes of its namespace; nothing overlaps`, () => {
    const { boxes, groups, arrows, width, height } = room(robots);
    assert.equal(groups.length, robots);
    const isInside = (a, b) => a.x >= b.x && a.y >= b.y && a.x + a.w <= b.x + b.w && a.y + a.h <= b.y + b.h;
    const overlap = (a, b) => a.x < b.x + b.w && b.x < a.x + a.w && a.y < b.y + b.h && b.y < a.y + a.h;
    for (const group of groups) {
      assert.ok(isInside(group, { x: 0, y: 0, w: width, h: height }));
      const title = { x: group.x, y: group.y, w: group.w, h: 20 };
      for (const [item, box] of Object.entries(boxes)) {
        const isOwn = item.split(" ")[1].startsWith(`${group.name}/`);
        assert.equal(group.items.includes(item), isOwn);
        assert.ok(isOwn ? isInside(box, group) : !overlap(box, group), `${item} and ${group.name}`);
        assert.ok(!overlap(box, title));
      }
      for (const { path } of arrows.filter(({ from, to: end }) => [from, end].every((item) => group.items.includes(item)))) {
        const rows = [...path.matchAll(/[\d.]+ ([\d.]+)/g)].map(([, y]) => Number(y));
        assert.ok(rows.every((y) => y > group.y && y < group.y + group.h), `${path} is in ${group.name}`);
      }
    }
    for (const all of [groups, Object.values(boxes)]) {
      all.forEach((a, i) => all.slice(0, i).forEach((b) => assert.ok(!overlap(a, b))));
    }
  });
}

test("what a group above is connected to comes first", () => {
  const items = ["a/x", "a/y", "b/talker", "c/x", "c/y"].map((name) => `node /${name}`).concat("topic /b/p", "topic /b/q");
  const edges = [...to("node /b/talker", "topic /b/p", "topic /b/q"), ...to("topic /b/p", "node /c/x"), ...to("topic /b/q", "node /a/x")];
  const { boxes } = layout(items, edges, groupsOf(items));
  assert.ok(boxes["topic /b/q"].y < boxes["topic /b/p"].y);
});

test("a node is in the group of its private topics; without a namespace there is no group", () => {
  assert.deepEqual(groupsOf(["node /base", "topic /base/power", "node /base_2", "node /rosout", "topic /rosout", "node bare"]),
    { "node /base": "/base", "topic /base/power": "/base" });
});

test("arrow keys reach every box, and stay in the column as long as it has one", () => {
  const { boxes } = room(3);
  const beside = (item, key) => itemBeside(boxes, item, key);
  assert.equal(beside("topic /robot_1/joy", "ArrowDown"), "topic /robot_2/joy");
  assert.equal(beside("topic /robot_1/joy", "ArrowUp"), undefined);
  assert.equal(beside("topic /robot_2/joy", "ArrowRight"), "node /robot_2/teleop");
  assert.equal(beside("node /joy_node", "ArrowLeft"), undefined);
  assert.equal(beside("node /joy_node", "Enter"), undefined);
  const reached = new Set(["node /joy_node"]);
  for (const item of reached) { // It grows meanwhile.
    for (const key of ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"]) {
      if (beside(item, key)) reached.add(beside(item, key));
    }
  }
  assert.equal(reached.size, Object.keys(boxes).length);
});

test("DOT has boxes, arrows and groups, whatever the names", () => {
  const items = ['node /a"b\\', "topic /x/y", "topic /x/z"];
  const lines = dotOf(layout(items, to(items[0], items[1]), groupsOf(items))).split("\n").map((line) => line.trim());
  assert.deepEqual(lines.slice(2, -2), [
    String.raw`"node /a\"b\\" [label="/a\"b\\" shape=ellipse]`,
    '"topic /x/y" [label="/x/y" shape=box]',
    '"topic /x/z" [label="/x/z" shape=box]',
    'subgraph "cluster /x" { label="/x" "topic /x/y" "topic /x/z" }',
    String.raw`"node /a\"b\\" -> "topic /x/y"`,
  ]);
});
