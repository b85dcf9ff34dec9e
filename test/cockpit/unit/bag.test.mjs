// Which fields of a recording are drawn at first, and which are offered; `node --test` runs it, see test/lint.
// claim: Tab Bag: which fields of a recording are drawn at first, and which are offered
import assert from "node:assert/strict";
import { test } from "node:test";

import { firstFields, namesOf } from "../../../common/cockpit/page/bag_tab.js";

const JOY = [["/joy/axes", 2], ["/joy/buttons", 3]];
const ODOM = ["x", "y", "z"].map((name) => [`/odom/pose/pose/position/${name}`, 0]);
const topics = (...types) => types.map((type) => ({ name: type.endsWith("Joy") ? "/joy" : "/odom", type }));

test("at first a joystick's axes are drawn, or a place, or the first numbers", () => {
  const [joy, odom] = ["sensor_msgs/Joy", "nav_msgs/Odometry"];
  const fields = [...JOY, ...ODOM];
  assert.deepEqual(firstFields({ topics: topics(odom, joy), fields }), ["/joy/axes[0]", "/joy/axes[1]"]);
  assert.deepEqual(firstFields({ topics: topics(odom), fields: ODOM }), [ODOM[0][0], ODOM[1][0]]);
  assert.equal(firstFields({ topics: topics("x/Y"), fields }).length, 3);
  assert.deepEqual(firstFields({ topics: [], fields: [] }), []);
});

test("entries of an array are offered up to a number", () => {
  assert.deepEqual(namesOf([["/a", 0], ["/b", 9]], 2), ["/a", "/b[0]", "/b[1]"]);
});
