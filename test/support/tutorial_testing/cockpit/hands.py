"""Three ways to hold LB and push the stick in a page: keys, thumbs on a touch screen, a gamepad."""

import contextlib

from selenium.common.exceptions import WebDriverException

from tutorial_testing.robot import TRY_S
from tutorial_testing.waiting import wait_for

SIT_DOWN = """document.getElementById("session").dataset.state !== "yours"
  && document.getElementById("take").click()"""
ARMED = "document.getElementById('session').dataset.armed"
# Replaces the browser's gamepads by one of the standard mapping: no browser here has a real one.
FAKE_GAMEPAD = """
globalThis.fake = {plugged: true, frozen: false, held: false, at: 0};
navigator.getGamepads = () => {
  if (!fake.plugged) return [null];
  if (!fake.frozen) fake.at = performance.now();
  const lb = {pressed: fake.held, value: +fake.held}, up = {pressed: false, value: 0};
  const buttons = [up, up, up, up, lb, ...Array(12).fill(up)];
  return [{id: "fake", index: 0, connected: true, mapping: "standard", timestamp: fake.at,
           axes: [0, fake.held ? -1 : 0, 0, 0], buttons}];
};
"""


class Hands:
    """hold() and release() at a page; drive() until the robot moves."""

    touch = False  # whether they need a touch screen

    def __init__(self, browser):
        self.browser = browser

    def prepare(self):
        """Prepare the browser, before the page is opened."""

    def still_held(self):
        """Repeat the input of hands that still hold all, as after a return to the page."""

    def drive(self, world, until=None):
        """Take the session if it is free, release all, and hold all until the robot moves, or until
        a condition(). On a busy machine this may take several attempts: a late page may not drive.
        """

        def hold():
            self.release()
            world.wait_for_rest()
            self.browser.ask(SIT_DOWN)
            # Once armed, the server has seen all released, and lets this page drive.
            with contextlib.suppress(AssertionError):
                wait_for(lambda: self.browser.ask(ARMED) == "true", "all released", TRY_S)
                self.hold()
                return True
            return False

        world.drive_by(hold, until)


class Keys(Hands):
    codes = ("ShiftLeft", "ArrowUp")

    def hold(self, repeats=False):
        for code in self.codes:
            self.browser.key("rawKeyDown", code, repeats)

    def still_held(self):
        self.hold(repeats=True)

    def release(self):
        for code in self.codes:
            self.browser.key("keyUp", code)


class Thumbs(Hands):
    touch = True
    down = False

    def hold(self):
        lb, (x, y) = self.browser.middle("#lb"), self.browser.middle("#stick")
        self.browser.touch("touchStart", lb)
        self.browser.touch("touchStart", lb, (x, y))
        self.browser.touch("touchMove", lb, (x, y - 70))
        self.down = True

    def release(self):
        if self.down:
            with contextlib.suppress(WebDriverException):  # they may have been cancelled
                self.browser.touch("touchEnd")
        self.down = False


class Gamepad(Hands):
    def prepare(self):
        self.browser.send("Page.addScriptToEvaluateOnNewDocument", source=FAKE_GAMEPAD)

    def set(self, **values):
        self.browser.driver.execute_script("Object.assign(fake, arguments[0])", values)

    def hold(self):
        self.set(held=True)

    def release(self):
        self.set(held=False)
