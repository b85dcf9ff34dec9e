"""A Chromium that a test uses as a person does: it reads, presses keys and touches the screen."""

import contextlib
import json
import shutil
import signal
import tempfile
import time

from selenium import webdriver
from selenium.common.exceptions import WebDriverException
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

from tutorial_testing.cockpit.engines import WebDriver
from tutorial_testing.processes import signal_all
from tutorial_testing.waiting import descendants, wait_for

ARGUMENTS = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
]  # fmt: skip
# Key code -> (name of the key, its number in Windows).
KEYS = {
    "ShiftLeft": ("Shift", 16), "ArrowUp": ("ArrowUp", 38), "ArrowRight": ("ArrowRight", 39),
    "Tab": ("Tab", 9), "Escape": ("Escape", 27), "Digit1": ("1", 49),
}  # fmt: skip
SHIFT = 8  # a modifier of the DevTools protocol


class Chromium(WebDriver):
    """A browser with one page. A context manager that leaves nothing behind."""

    def __init__(self, *arguments):
        self._folder = tempfile.mkdtemp()
        self._modifiers = 0
        options = Options()
        options.binary_location = shutil.which("chromium")
        for argument in (*ARGUMENTS, *arguments, "--window-size=1280,800"):
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
            self.errors()  # dropped, so that a later test sees its own only

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
        """Click on the button with this accessible name."""
        [button] = [button for button in self.all(css) if button.accessible_name == name]
        button.click()

    def tab(self, name):
        self.click(name, "[role=tab]")

    def errors(self):
        """Return the console's errors, except of connections that a closing page gave up."""
        log = [e["message"] for e in self.driver.get_log("browser") if e["level"] != "INFO"]
        return [text for text in log if "closed before the connection is established" not in text]

    def key(self, kind, code, repeats=False):
        """kind: "rawKeyDown" or "keyUp". repeats: whether a held key repeats itself."""
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
        box = self.ask(f"document.querySelector({json.dumps(css)}).getBoundingClientRect()")
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    @property
    def pids(self):
        return descendants(self.driver.service.process.pid)[1:]

    def signal(self, number):
        """Send a signal to all processes of the browser; return the time [s] just before."""
        return signal_all(self.pids, number)

    def kill(self):
        """Kill it with SIGKILL; return the time [s] just before."""
        return self.signal(signal.SIGKILL)

    def hide(self):
        """Show another tab in front of the page; return (the other tab, the time [s] before)."""
        new = self.send("Target.createTarget", url="about:blank", background=True)["targetId"]
        now = time.time()
        self.send("Target.activateTarget", targetId=new)
        return new, now

    def show(self, other):
        """Close that tab, and wait until the page is visible."""
        self.send("Target.activateTarget", targetId=self.driver.current_window_handle)
        self.send("Target.closeTarget", targetId=other)
        wait_for(lambda: self.ask("document.visibilityState") == "visible", "page")
