"""A virtual F710 in the kernel drives the simulated robot through the cockpit's page in Chromium.

In both of its modes: Chromium brings each into the standard layout by a table of its own. It knows
gamepads from udev, so systemd-udevd has to run. Prints as drive.py does.
"""

import platform
import time

from gamepad.gamepads import F710
from gamepad.virtual.controls import Controls, positions
from gamepad.virtual.pads import UinputPad
from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.hands import SIT_DOWN, Hands
from tutorial_testing.cockpit.world import World
from tutorial_testing.kernel.drive import DEADLINE_S, FORWARD, HELD, METRES_PER_S, report
from tutorial_testing.waiting import wait_for

# What is demanded of the cockpit: half a second, and a period of the odometry.
LIMIT_S = 0.5 + 0.02
FAR_M = 0.5  # longer than a second: the gamepad's own time stands still where the stick does
SEEN = """navigator.getGamepads().filter((pad) => pad?.connected).map(
  (pad) => ({id: pad.id, mapping: pad.mapping, axes: pad.axes.length}))"""


class KernelGamepad(Hands):
    """A gamepad of the kernel. mode: "D" or "X"."""

    def __init__(self, browser, pad, mode):
        super().__init__(browser)
        self._pad, self._mode = pad, mode

    def show(self, controls):
        self._pad.show(positions(F710[self._mode], controls))

    def hold(self):
        self.show(HELD)

    def release(self):
        self.show(Controls())

    def wait_until_seen(self):
        """Wait for the only gamepad in the page; return what it sees of it."""
        return wait_for(lambda: self.browser.ask(SEEN), "gamepad in the page", DEADLINE_S)[0]


def judge(world, since, what):
    """Check that the robot stands soon after a time [s]."""
    took_s = world.wait_for_rest() - since
    report(f"{what}: the robot stands after {1e3 * took_s:.0f} ms")
    assert took_s < LIMIT_S


def check_mode(browser, world, mode):
    """Check what the page makes of an F710 in a mode, from the first button to its end."""
    with UinputPad(F710[mode]) as pad:
        hands = KernelGamepad(browser, pad, mode)
        # A page gets to know a gamepad by a button that is pressed.
        hands.show(Controls(held=frozenset(["A"])))
        seen = hands.wait_until_seen()
        report(f"F710 at {mode}: {seen['id']}, mapping {seen['mapping']!r}, {seen['axes']} axes")
        hands.release()
        check_drive(world, hands)
        hands.drive(world)
        since = time.time()
        pad.show(None)
        judge(world, since, "unplugged while driving")
    wait_for(lambda: not browser.ask(SEEN), "page without a gamepad", DEADLINE_S)


def check_drive(world, hands):
    """Check that the robot drives with LB held only, and stands when it is released."""
    world.wait_for_rest()
    hands.show(FORWARD)
    assert world.stays_at_rest()
    begin_m = world.now.x
    hands.drive(world, until=lambda: world.now.x > begin_m + FAR_M)
    speed = world.now.v
    report(f"LB held and the stick pushed for {FAR_M} m: {speed:.3f} m/s")
    assert abs(speed - METRES_PER_S) < 1e-3
    since = time.time()
    hands.show(FORWARD)
    judge(world, since, "LB released")


def sits_down(browser):
    """Return whether this page drives; if not, it asks to."""
    browser.ask(SIT_DOWN)
    return "You drive" in browser.text("#seat")


def main():
    report(f"Linux {platform.release()}, {platform.machine()}")
    with World() as world:
        report("the robot and its cockpit run")
        with Chromium() as browser:
            report(f"Chromium {browser.driver.capabilities['browserVersion']} runs")
            browser.open(world.address)
            report("the page is open")
            wait_for(lambda: sits_down(browser), "seat of the driver", DEADLINE_S)
            for mode in ("X", "D"):
                check_mode(browser, world, mode)
            assert browser.errors() == []
    report("passed")


if __name__ == "__main__":
    main()
