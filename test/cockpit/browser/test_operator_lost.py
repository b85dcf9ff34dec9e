"""The ways to lose the operator, and how long the robot drives on; `--trials 20` for the table."""

import contextlib
import signal
import time
from types import SimpleNamespace
from typing import Callable, NamedTuple, Optional

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.hands import Gamepad, Keys, Thumbs
from tutorial_testing.cockpit.world import World
from tutorial_testing.two_hosts.network import AS_ROOT, Network
from tutorial_testing.waiting import tolerance, wait_for

LIMIT_S = 0.5 + 0.02  # promised: half a second, and a period of the odometry
STEADY_S = 1.0  # with a steady stick; more than driver_session.TICKS periods
ROBOT, PHONE = "10.11.12.1", "10.11.12.2"
CUT = "network cut"


class Way(NamedTuple):
    """A way to lose the operator, and the way back, or None; both get browser, hands and world.

    lose() returns the time of the loss [s], or None if it is that of the call.
    """

    lose: Callable
    back: Optional[Callable]
    hands: type = Keys
    page_stays: bool = True  # the page that drove is still open after back()


def close_tab(it):
    driven = it.browser.driver.current_window_handle
    it.browser.send("Target.createTarget", url="about:blank", background=True)
    now = time.time()
    it.browser.send("Target.closeTarget", targetId=driven)
    return now


def open_again(it):
    it.browser.driver.switch_to.window(it.browser.driver.window_handles[0])
    it.browser.open(it.world.address)


def hide(it):
    it.other, now = it.browser.hide()
    return now


def event(name):
    return lambda it: it.browser.driver.execute_script(f"dispatchEvent(new Event('{name}'))")


def mouse(kind):
    return lambda it: it.browser.mouse(kind, "#teleop", button="right", shift=True)


def close_list(it):
    it.browser.mouse("mouseReleased", "#connection", "left")
    it.browser.tab("Robot")


def cancel_touch(it):
    it.browser.touch("touchCancel")


def gamepad(**values):
    return lambda it: it.hands.set(**values)


def freeze_gamepad(it):
    """Stop the gamepad's clock, which advances while a working gamepad is held still."""
    steady_from = it.world.odometry[-1].stamp + STEADY_S
    wait_for(lambda: it.world.odometry[-1].stamp > steady_from, "driving with a steady stick")
    it.hands.set(frozen=True)
    # The page knows when it froze: on a busy machine this call may have come late.
    return it.browser.ask("(performance.timeOrigin + fake.at) / 1000")


def end_server(it):
    now = it.world.cockpit.signal(signal.SIGINT)
    it.world.cockpit.wait()
    return now


def start_server(it):
    wait_for(lambda: "lost" in it.browser.text("#connection"), "report of the loss", 5)
    it.browser.wait_for_text("#notice", "Start it again")  # after some attempts
    it.world.start_cockpit()
    it.browser.wait_for_text("#connection", "Connected")
    assert "Start it again" not in it.browser.text("#notice")
    it.browser.wait_for_text("#session", "Nobody drives")
    wait_for(lambda: "/cockpit" not in it.browser.text("#session"), "end of the killed cockpit")


def plug_cable(it):
    it.browser.wait_for_text("#connection", "lost")
    it.world.network.plug_cable("phone")
    it.browser.wait_for_text("#connection", "Connected")


WAYS = {
    "tab closed": Way(close_tab, open_again, page_stays=False),
    "page hidden": Way(hide, lambda it: it.browser.show(it.other)),
    "browser killed with -9": Way(lambda it: it.browser.kill(), None, page_stays=False),
    "page frozen (SIGSTOP)": Way(
        lambda it: it.browser.signal(signal.SIGSTOP), lambda it: it.browser.signal(signal.SIGCONT)
    ),
    # Without a screen no window loses the focus, so the test sends the event.
    "Alt-Tab with a key held": Way(event("blur"), event("focus")),
    "pointercancel": Way(cancel_touch, lambda it: setattr(it.hands, "down", False), Thumbs),
    # The menu receives the keys, so that the page does not see their release.
    "right button of the mouse": Way(mouse("mousePressed"), mouse("mouseReleased")),
    # So does an open list, which a driver may open on any tab.
    "a list": Way(lambda it: it.browser.mouse("mousePressed", "#mode", "left", True), close_list),
    "gamepad unplugged": Way(gamepad(plugged=False), gamepad(plugged=True), Gamepad),
    "gamepad frozen": Way(freeze_gamepad, gamepad(frozen=False), Gamepad),
    "server killed with -9": Way(lambda it: it.world.cockpit.kill(), start_server),
    "server ended": Way(end_server, start_server),
    CUT: Way(lambda it: it.world.network.pull_cable("phone"), plug_cable),
}


def lose(way, it):
    """Lose the operator of a moving robot; return how long it drove on [s].

    Return None if a busy machine had already lost the operator.
    """
    it.hands.drive(it.world)
    now, late_s = time.time(), tolerance()
    lost_at = way.lose(it) or now
    rest = it.world.wait_for_rest()
    before = [moment for moment in it.world.odometry if moment.stamp <= lost_at]
    if not before[-1].moves:
        return None
    assert rest - lost_at < LIMIT_S + late_s()
    return rest - lost_at


def come_back(way, it):
    """Come back with all still held: nothing moves. Release and hold again: the robot drives."""
    if way.back:
        way.back(it)
    if way.page_stays:
        it.hands.still_held()
    assert it.world.stays_at_rest()
    if way.back:
        held = "document.querySelector('#lb').classList.contains('held')"
        it.hands.drive(it.world, until=lambda: it.world.moves and it.browser.ask(held))
        it.hands.release()
        it.world.wait_for_rest()


def lose_and_come_back(request, name, world, browser_of=Chromium):
    way, count = WAYS[name], 0
    while count < request.config.getoption("--trials"):
        with browser_of() as browser:
            it = SimpleNamespace(browser=browser, hands=way.hands(browser), world=world)
            it.hands.prepare()
            browser.open(world.address)
            took_s = lose(way, it)
            come_back(way, it)
        if took_s is not None:
            count += 1
            request.node.user_properties.append((name, took_s))


@claim("Keys, thumbs and a gamepad ...", because="end to end")
@claim("Each loss of the operator ...", because="end to end")
@pytest.mark.parametrize("name", [name for name in WAYS if name != CUT])
def test_the_robot_comes_to_rest_and_stays(world, name, request, shared_browser):
    size = (360, 640, True) if WAYS[name].hands.touch else (1280, 800)
    tab = lambda: shared_browser.tab_of(*size)  # noqa: E731
    lose_and_come_back(request, name, world, tab if WAYS[name].back else Chromium)


@claim("The end of a drive ...", because="end to end, when the network is cut")
def test_a_cut_network_and_its_return(request):
    if not AS_ROOT:
        pytest.skip("only root may use a browser on another host of a network of namespaces")
    with contextlib.ExitStack() as stack:
        network = stack.enter_context(Network({"robot": ROBOT, "phone": PHONE}))
        world = stack.enter_context(World(host=network["robot"], address=ROBOT))
        world.network = network
        stack.enter_context(network["phone"].inside())
        lose_and_come_back(request, CUT, world)
