#!/usr/bin/python3
"""Ways to lose the operator, at the level of the protocol; the browser's own are test/browser's."""

import statistics
import time

from cockpit_server.seat import is_neutral
from tutorial_testing.cockpit_rig import WithCockpit
from tutorial_testing.robot import PERIOD_S
from tutorial_testing.rostests import run
from tutorial_testing.waiting import Stopwatch

WITHIN_S = 0.5 + PERIOD_S
ROUNDS = 3  # per way; on a busy machine one may be late


class OperatorLost(WithCockpit):
    def assert_stops(self, lose, **regained):
        """Lose the operator of a moving robot, who comes back with the stick still held.

        regained: attributes of the page, once the operator is back.
        """
        took = []
        for _ in range(ROUNDS):
            with self.rig.page() as page:
                self.rig.drive(page)
                when, watch, count = time.time(), Stopwatch(), len(self.rig.joys)
                lose(page)
                took.append(self.rig.wait_for_rest(when) - when - watch.lost_s)
                self.assertTrue(self.rig.stays_at_rest())
                last = [is_neutral(joy.axes, joy.buttons) for joy in self.rig.joys[count:]]
                self.assertEqual((sum(last), last[-1]), (1, True), last)  # one, then silence
                vars(page).update(regained)
                self.assertTrue(self.rig.drives_only_once_released(page))
                page.say("stop")
                self.rig.wait_for_rest(time.time())
        print(f"{self._testMethodName}: at rest after {', '.join(f'{t:.3f}' for t in took)} s")
        self.assertLessEqual(statistics.median(took), WITHIN_S)

    def test_silence(self):
        self.assert_stops(lambda page: vars(page).update(hand=None))

    def test_input_from_a_queue(self):
        self.assert_stops(lambda page: vars(page).update(delay_s=0.5), delay_s=0.0)

    def test_page_that_hears_nothing(self):
        self.assert_stops(lambda page: vars(page).update(sees_beats=False), sees_beats=True)

    def test_release(self):
        self.assert_stops(lambda page: page.say("release", why="hidden"))


if __name__ == "__main__":
    run()
