#!/usr/bin/python3
"""Ways to lose the operator, at the level of the protocol; the browser's own are test/browser's."""

import os
import signal
import statistics
import time

import rostest

from cockpit_server.seat import TICKS, is_neutral
from tutorial_testing.cockpit_rig import ODOM_PERIOD_S, WithCockpit
from tutorial_testing.nodes import init_node
from tutorial_testing.waiting import wait_for

WITHIN_S = 0.5 + ODOM_PERIOD_S
ROUNDS = 3  # of each way; on a busy machine one may be late


class OperatorLost(WithCockpit):
    def assert_stops(self, lose, regain):
        """lose(page) and regain(page): the operator is gone, and is there again, still holding.

        lose() may return when it was [s]; else it is when it was called.
        """
        took = []
        for _ in range(ROUNDS):
            with self.rig.page() as page:
                self.rig.drive(page)
                when = time.time()
                when = lose(page) or when
                took.append(self.rig.rest_after(when))
                self.assert_one_neutral(when)
                regain(page)
                self.assertTrue(self.rig.drives_only_once_released(page))
                page.say("leave")
                self.rig.rest_after(time.time())
        print(f"{self._testMethodName}: at rest after {', '.join(f'{t:.3f}' for t in took)} s")
        self.assertLessEqual(statistics.median(took), WITHIN_S)

    def assert_one_neutral(self, when):
        """After the last that was held comes one neutral message, and then nothing."""
        self.assertTrue(self.rig.stays_at_rest())
        last = [is_neutral(axes, buttons) for came, axes, buttons in self.rig.joys if came > when]
        self.assertEqual(last[-1:], [True])
        self.assertEqual(sum(last), 1, last)

    def test_silence(self):
        def lose(page):
            page.hand = None

        self.assert_stops(lose, lambda page: None)

    def test_input_from_a_queue(self):
        def lose(page):
            page.delay_s = 0.5

        def regain(page):
            page.delay_s = 0.0

        self.assert_stops(lose, regain)

    def test_a_page_that_hears_nothing(self):
        def lose(page):
            page.sees_beats = False

        def regain(page):
            page.sees_beats = True

        self.assert_stops(lose, regain)

    def test_a_gamepad_that_stands_still(self):
        asked = []

        def goes_on():
            asked.append(1000 * time.time())
            return asked[-1]

        def lose(page):
            asked.clear()
            page.pad = goes_on
            wait_for(lambda: len(asked) > 2 * TICKS, "time of the gamepad that goes on")
            page.pad = lambda: asked[-1]
            return asked[-1] / 1000

        def regain(page):
            page.pad = goes_on

        self.assert_stops(lose, regain)

    def test_release(self):
        self.assert_stops(lambda page: page.say("release", why="hidden"), lambda page: None)

    def test_a_page_that_is_closed_and_opened_anew(self):
        took = []
        for _ in range(ROUNDS):
            with self.rig.page() as page:
                self.rig.drive(page)
                when = time.time()
                page.close()
                took.append(self.rig.rest_after(when))
                self.assert_one_neutral(when)
            with self.rig.page() as page:
                page.say("drive", robot="", mode="D")
                self.assertTrue(self.rig.drives_only_once_released(page))
                page.say("leave")
                self.rig.rest_after(time.time())
        self.assertLessEqual(statistics.median(took), WITHIN_S)

    def test_the_server_ends(self):
        for number in (signal.SIGTERM, signal.SIGKILL):
            took = []
            for _ in range(ROUNDS):
                with self.rig.page() as page:
                    self.rig.drive(page)
                    pids = self.rig.program.left_behind()
                    when = time.time()
                    for pid in pids:
                        os.kill(pid, number)
                    took.append(self.rig.rest_after(when))
                    if number == signal.SIGTERM:
                        self.assert_one_neutral(when)
                wait_for(lambda: self.rig.program.ended, "end of the cockpit")
                self.rig.start()
                with self.rig.page() as page:
                    page.say("drive", robot="", mode="D")
                    self.assertTrue(self.rig.drives_only_once_released(page))
                    page.say("leave")
                    self.rig.rest_after(time.time())
            print(f"signal {number}: at rest after {took} s")
            self.assertLessEqual(statistics.median(took), WITHIN_S)


if __name__ == "__main__":
    init_node("cockpit_lost")
    rostest.rosrun("ros1_tutorial_test", "cockpit_lost", OperatorLost)
