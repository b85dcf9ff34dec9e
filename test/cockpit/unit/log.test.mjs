// What the tab Log makes of a line's place, and of a search.
// claim: Log: the line of a program in brief, in Python and C++; a search includes and excludes
import assert from "node:assert/strict";
import { test } from "node:test";

import { matcher } from "../../../common/cockpit/page/dom.js";
import { briefPlace } from "../../../common/cockpit/page/log_tab.js";

for (const [place, brief] of [
  ["talker.py:12(talker)", "talker.py:12 talker()"],
  ["log.py:74(Log._warn)", "log.py:74 Log._warn()"],
  ["talker.py:3(<module>)", "talker.py:3"],
  ["~/ws/src/my (2)/talker.cpp:12(int main(int, char**))", "talker.cpp:12 main()"],
  ["./a.cpp:7(void Listener::hear(const boost::shared_ptr<const std_msgs::String_<std::allocator<void> > >&))",
    "a.cpp:7 Listener::hear()"],
  ["./a.cpp:9(main(int, char**)::<lambda(const std_msgs::String&)>)", "a.cpp:9 main()"],
  ["a.cpp:5()", "a.cpp:5"],
  ["a.cpp:5(\n)", "a.cpp:5"],
  ["", ""],
]) test(`place ${place}`, () => assert.equal(briefPlace(place), brief));

test("a search has all words, and none that follows a minus", () => {
  const found = (search) => ["/talker Hello 1", "/talker hello 2", "/odom-watch lost"].filter(matcher(search));
  assert.equal(found("").length, 3);
  assert.equal(found(" - ").length, 3); // before its word is typed
  assert.deepEqual(found("HELLO 2"), ["/talker hello 2"]);
  assert.deepEqual(found("-hello"), ["/odom-watch lost"]);
  assert.deepEqual(found("talker -2"), ["/talker Hello 1"]);
  assert.deepEqual(found("odom-watch"), ["/odom-watch lost"]);
});
