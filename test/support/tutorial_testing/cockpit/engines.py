"""Browsers with the cockpit's page: what all can do, those of WebDriver, and Firefox."""

import asyncio
import json
import re
import shutil
import tempfile

from selenium.webdriver.common.action_chains import ActionChains
from tornado.websocket import websocket_connect

from tutorial_testing.processes import Program, Started
from tutorial_testing.waiting import DEADLINE_S, wait_for


class Browser(Started):
    """A browser with one page; a subclass defines go(address) and ask(expression)."""

    def open(self, address):
        """Open the cockpit's page, and wait until it is connected."""
        self.go(address)
        self.wait_for_text("#connection", "Connected")

    def text(self, css):
        """Return the text of an element, visible or not; "" if it does not exist."""
        return self.ask(f"document.querySelector({json.dumps(css)})?.textContent ?? ''")

    def wait_for_text(self, css, text):
        wait_for(lambda: text in self.text(css), f"{text} in {css}", seen=lambda: self.text(css))

    def press(self, css):
        """Click on an element, visible or not."""
        click = "dispatchEvent(new MouseEvent('click', {bubbles: true}))"  # SVG has no click()
        self.ask(f"document.querySelector({json.dumps(css)}).{click}")


class WebDriver(Browser):
    def __init__(self, driver):
        super().__init__()
        self.driver = driver

    def go(self, address):
        self.driver.get(address)

    def ask(self, expression):
        return self.driver.execute_script(f"return {expression}")

    def keys(self, kind, *keys):
        """kind: keyDown or keyUp. keys: in turn, by their codes in the WebDriver standard."""
        actions = ActionChains(self.driver)
        for key in keys:
            (actions.key_down if kind == "keyDown" else actions.key_up)(key)
        actions.perform()


class Firefox(Browser):
    """Firefox over WebDriver BiDi, used directly: Debian has no geckodriver.

    https://w3c.github.io/webdriver-bidi: JSON over a WebSocket.
    """

    def begin(self):
        profile = tempfile.mkdtemp()
        self._stack.callback(shutil.rmtree, profile, ignore_errors=True)
        self._loop = asyncio.new_event_loop()
        self._stack.callback(self._loop.close)
        options = ["--headless", "--no-remote", "--remote-debugging-port", "0"]
        program = Program("firefox-esr", *options, "--profile", profile)
        self._stack.enter_context(program)
        line = r"BiDi listening on (ws://\S+)"
        match = wait_for(lambda: re.search(line, program.output), "Firefox")
        self._number = 0
        self._socket = self._wait(websocket_connect, f"{match[1]}/session")
        self.send("session.new", capabilities={})
        self._context = self.send("browsingContext.getTree")["contexts"][0]["context"]

    def _wait(self, call, *arguments):
        async def waited():
            return await asyncio.wait_for(call(*arguments), DEADLINE_S)

        return self._loop.run_until_complete(waited())

    def send(self, method, **parameters):
        """Send a command; return its result. RuntimeError with Firefox's message if it refuses."""
        self._number += 1
        command = {"id": self._number, "method": method, "params": parameters}
        self._wait(self._socket.write_message, json.dumps(command))
        answer = {}
        while answer.get("id") != self._number:
            answer = json.loads(self._wait(self._socket.read_message))
        if answer["type"] != "success":
            raise RuntimeError(f"{method}: {answer['message']}")
        return answer["result"]

    def go(self, address):
        self.send("browsingContext.navigate", context=self._context, url=address, wait="complete")

    def ask(self, expression):
        """Return the value of a JavaScript expression: a text, a number or a truth value."""
        fields = {"target": {"context": self._context}, "awaitPromise": False}
        answer = self.send("script.evaluate", expression=expression, **fields)
        if answer["type"] != "success":
            raise RuntimeError(answer["exceptionDetails"]["text"])
        return answer["result"].get("value")

    def keys(self, kind, *keys):
        actions = [{"type": kind, "value": key} for key in keys]
        source = {"type": "key", "id": "keyboard", "actions": actions}
        self.send("input.performActions", context=self._context, actions=[source])
