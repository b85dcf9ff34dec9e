"""A virtual F710 in the kernel drives the simulated robot through the cockpit's page in Chromium.

Chromium has a layout for each of its two modes, and learns of gamepads from udev.
"""

from drive import FORWARD, HELD, METRES_PER_S, check_stop

from gamepad.gamepads import F710
from gamepad.io.pads import UinputPad
from gamepad.virtual.controls import Controls, positions
from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.hands import Hands
from tutorial_testing.cockpit.world import World
from tutorial_testing.waiting import wait_for

LIMIT_S = 0.5  # until a released LB or a lost gamepad has its effect
SEEN = "navigator.getGamepads().filter((pad) => pad?.connected).map((pad) => pad.mapping)"


def check_mode(browser, world, mode):
    """Check an F710 in a mode on the page, from its first button to its end."""
    with UinputPad(F710[mode]) as pad:
        show = lambda controls: pad.show(positions(F710[mode], controls))  # noqa: E731
        hands = Hands(browser)
        hands.hold, hands.release = lambda: show(HELD), lambda: show(Controls())
        show(Controls(held=frozenset(["A"])))  # a page sees a gamepad once a button is pressed
        assert wait_for(lambda: browser.ask(SEEN), "gamepad in the page") == ["standard"]
        # For longer than a second: a gamepad's timestamp does not change while its stick is still.
        begin_m = world.now.x
        hands.drive(world, until=lambda: world.now.x > begin_m + 0.5)
        assert abs(world.now.v - METRES_PER_S) < 1e-3
        for end in (lambda: show(FORWARD), lambda: pad.show(None)):  # LB released; unplugged
            hands.drive(world)
            check_stop(world, end, LIMIT_S)
    wait_for(lambda: not browser.ask(SEEN), "page without a gamepad")


if __name__ == "__main__":
    with World() as world, Chromium() as browser:
        browser.open(world.address)
        for mode in ("X", "D"):
            check_mode(browser, world, mode)
        assert browser.errors() == []
    print("drive: passed")
