"""A Chromium that a test uses as a person does: looks, presses keys, touches glass."""

import contextlib
import shutil
import signal
import tempfile

from selenium import webdriver
from selenium.common.exceptions import WebDriverException
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

from tutorial_testing.cockpit.engines import WebDriver
from tutorial_testing.processes import signal_all
from tutorial_testing.waiting import descendants

ARGUMENTS = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
]  # fmt: skip
# Key code -> name of the key and the number that Windows has for it.
KEYS = {
    "ShiftLeft": ("Shift", 16), "ArrowUp": ("ArrowUp", 38), "ArrowRight": ("ArrowRight", 39),
    "Tab": ("Tab", 9), "Escape": ("Escape", 27),
}  # fmt: skip
SHIFT = 8  # as the protocol has modifiers


class Chromium(WebDriver):
    """One browser with one page. A context manager that leaves nothing behind."""

    def __init__(self):
        self._folder = tempfile.mkdtemp()
        self._modifiers = 0
        options = Options()
        options.binary_location = shutil.which("chromium")
        for argument in (*ARGUMENTS, "--window-size=1280,800"):
            options.add_argument(argument)
        options.add_argument(f"--user-data-dir={self._folder}")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        service = Service(shutil.which("chromedriver"))
        super().__init__(webdriver.Chrome(service=service, options=options))
        self.resize()

    @contextlib.contextmanager
    def tab_of(self, width, height, touch=False):
        """Open a tab of this size, which takes far less time than another browser."""
        first = self.driver.current_window_handle
        self.driver.switch_to.new_window("tab")
        self.resize(width, height, touch)
        if touch:
            self.send("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
        try:
            yield self
        finally:
            for other in set(self.driver.window_handles) - {first}:
                self.driver.switch_to.window(other)
                self.driver.close()
            self.driver.switch_to.window(first)
            self.driver.get("about:blank")
            self.errors()  # a test that looks for errors later finds its own

    def __exit__(self, *_):
        self.kill()
        with contextlib.suppress(WebDriverException, OSError):
            self.driver.service.stop()
        shutil.rmtree(self._folder, ignore_errors=True)

    def go(self, address):
        self._modifiers = 0
        self.driver.get(address)

    def send(self, method, **parameters):
        return self.driver.execute_cdp_cmd(method, parameters)

    def resize(self, width=1280, height=800, touch=False):
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": touch}
        self.send("Emulation.setDeviceMetricsOverride", **metrics)

    def one(self, css):
        return self.driver.find_element(By.CSS_SELECTOR, css)

    def all(self, css):
        return self.driver.find_elements(By.CSS_SELECTOR, css)

    def click(self, name, css="button"):
        """Click on the button of a name, as a screen reader has it."""
        [found] = [one for one in self.all(css) if one.accessible_name == name]
        found.click()

    def tab(self, name):
        self.click(name, "[role=tab]")

    def errors(self):
        """Return the console's errors, except for a connection that the page gave up."""
        found = [e["message"] for e in self.driver.get_log("browser") if e["level"] != "INFO"]
        return [one for one in found if "closed before the connection is established" not in one]

    def key(self, kind, code, repeats=False):
        """kind: "rawKeyDown" or "keyUp". repeats: as a key does that is held."""
        name, number = KEYS[code]
        if name == "Shift":
            self._modifiers = 0 if kind == "keyUp" else SHIFT
        self.send("Input.dispatchKeyEvent", type=kind, code=code, key=name, autoRepeat=repeats,
                  windowsVirtualKeyCode=number, modifiers=self._modifiers)  # fmt: skip

    def mouse(self, kind, css, button="none", shift=False):
        """kind: "mouseMoved", "mousePressed" or "mouseReleased", in the middle of an element."""
        x, y = self.middle(css)
        self.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, clickCount=1,
                  modifiers=SHIFT if shift else 0)  # fmt: skip

    def touch(self, kind, *points):
        """kind: "touchStart", "touchMove", "touchEnd", "touchCancel". points: (x, y) [pixel]."""
        fingers = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        self.send("Input.dispatchTouchEvent", type=kind, touchPoints=fingers)

    def middle(self, css):
        """Return the middle of an element in the window [pixel], however the page is scrolled."""
        box = self.driver.execute_script(
            "return arguments[0].getBoundingClientRect()", self.one(css)
        )
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    @property
    def pids(self):
        return descendants(self.driver.service.process.pid)[1:]

    def signal(self, number):
        """Send a signal to all of the browser; return the time [s] just before."""
        return signal_all(self.pids, number)

    def kill(self):
        """Send SIGKILL; return the time [s] just before."""
        return self.signal(signal.SIGKILL)
