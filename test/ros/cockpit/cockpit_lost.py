#!/usr/bin/python3
"""Ways to lose the operator, at the level of the protocol; the browser's own are test/browser's."""

import contextlib
import signal
import statistics
import time

from cockpit_server.seat import is_neutral
from tutorial_testing.cockpit_rig import WithCockpit
from tutorial_testing.robot import PERIOD_S
from tutorial_testing.rostests import run
from tutorial_testing.socket_page import SocketPage
from tutorial_testing.waiting import wait_for

WITHIN_S = 0.5 + PERIOD_S
ROUNDS = 3  # of each way; on a busy machine one may be late


def change(**how):
    """Return an action that changes how a page speaks and hears."""
    return lambda page: vars(page).update(how)


class OperatorLost(WithCockpit):
    def assert_stops(self, lose, regain=None, neutral=1):
        """Lose the operator while the robot drives. regain: the operator, who still holds the
        stick, is there again; None: on a page that is opened anew. neutral: messages that come.
        """
        took = []
        for _ in range(ROUNDS):
            with contextlib.ExitStack() as stack:
                page = stack.enter_context(self.rig.page())
                self.rig.drive(page)
                when, count = time.time(), len(self.rig.joys)
                lose(page)
                took.append(self.rig.wait_for_rest(when) - when)
                self.assertTrue(self.rig.stays_at_rest())
                last = [is_neutral(joy.axes, joy.buttons) for joy in self.rig.joys[count:]]
                self.assertEqual(sum(last), neutral, last)
                self.assertTrue(not neutral or last[-1], last)
                if regain:
                    regain(page)
                else:
                    page = stack.enter_context(self.page_anew())
                self.assertTrue(self.rig.drives_only_once_released(page))
                page.say("stop")
                self.rig.wait_for_rest(time.time())
        print(f"{self._testMethodName}: at rest after {', '.join(f'{t:.3f}' for t in took)} s")
        self.assertLessEqual(statistics.median(took), WITHIN_S)

    @contextlib.contextmanager
    def page_anew(self):
        with self.rig.page() as page:
            page.say("drive", robot="", mode="D")
            yield page

    def test_silence(self):
        self.assert_stops(change(hand=None), change())

    def test_input_from_a_queue(self):
        self.assert_stops(change(delay_s=0.5), change(delay_s=0.0))

    def test_a_page_that_hears_nothing(self):
        self.assert_stops(change(sees_beats=False), change(sees_beats=True))

    def test_release(self):
        self.assert_stops(lambda page: page.say("release", why="hidden"), change())

    def test_a_page_that_is_closed_and_opened_anew(self):
        self.assert_stops(SocketPage.close)

    def end_server(self, number):
        self.rig.program.signal(number)
        wait_for(lambda: self.rig.program.ended, "end of the cockpit")
        self.rig.start()

    def test_the_server_ends(self):
        self.assert_stops(lambda _: self.end_server(signal.SIGTERM))

    def test_the_server_is_killed(self):
        self.assert_stops(lambda _: self.end_server(signal.SIGKILL), neutral=0)


if __name__ == "__main__":
    run()
