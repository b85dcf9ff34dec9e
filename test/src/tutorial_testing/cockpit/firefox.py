"""Firefox over WebDriver BiDi, spoken directly: Debian has no geckodriver.

https://w3c.github.io/webdriver-bidi: JSON over a WebSocket, {id, method, params} and its answer.
"""

import asyncio
import json
import re
import shutil
import tempfile

from tornado.websocket import websocket_connect

from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

LONG_S = 90.0  # for a machine that is busy with much else


class Firefox:
    """A Firefox with one page. A context manager that leaves nothing behind."""

    def __init__(self):
        self._profile = tempfile.mkdtemp()
        self._loop = asyncio.new_event_loop()
        self._number = 0

    def __enter__(self):
        options = ["--headless", "--no-remote", "--remote-debugging-port", "0"]
        self._program = Program("firefox-esr", *options, "--profile", self._profile)
        try:
            self._begin()
        except BaseException:
            self.__exit__()
            raise
        return self

    def _begin(self):
        said = r"BiDi listening on (ws://\S+)"
        found = wait_for(lambda: re.search(said, self._program.output), "Firefox", LONG_S)
        self._socket = self._wait(websocket_connect, f"{found[1]}/session")
        self.send("session.new", capabilities={})
        self._context = self.send("browsingContext.getTree")["contexts"][0]["context"]

    def __exit__(self, *_):
        self._program.__exit__()
        self._loop.close()
        shutil.rmtree(self._profile, ignore_errors=True)

    def _wait(self, call, *arguments):
        async def waited():
            return await asyncio.wait_for(call(*arguments), LONG_S)

        return self._loop.run_until_complete(waited())

    def send(self, method, **parameters):
        """A command; returns its result. RuntimeError with Firefox's words if it refuses."""
        self._number += 1
        command = {"id": self._number, "method": method, "params": parameters}
        self._wait(self._socket.write_message, json.dumps(command))
        while True:
            answer = json.loads(self._wait(self._socket.read_message))
            if answer.get("id") == self._number:
                break
        if answer["type"] != "success":
            raise RuntimeError(f"{method}: {answer['message']}")
        return answer["result"]

    def open(self, address):
        """Open the cockpit's page, and wait until it is connected."""
        self.send("browsingContext.navigate", context=self._context, url=address, wait="complete")
        self.wait_for_text("#connection", "Connected")

    def ask(self, expression):
        """The value of a JavaScript expression: a text, a number or a truth value."""
        target = {"context": self._context}
        said = self.send(
            "script.evaluate", expression=expression, target=target, awaitPromise=False
        )
        if said["type"] != "success":
            raise RuntimeError(said["exceptionDetails"]["text"])
        return said["result"].get("value")

    def text(self, css):
        """The text of an element, seen or not; "" if it is not there."""
        return self.ask(f"document.querySelector({json.dumps(css)})?.textContent ?? ''")

    def wait_for_text(self, css, text):
        wait_for(lambda: text in self.text(css), text, LONG_S)

    def click(self, css):
        self.ask(f"document.querySelector({json.dumps(css)}).click()")

    def keys(self, kind, *keys):
        """kind: keyDown or keyUp, of each key in turn, as the WebDriver standard codes them."""
        actions = [{"type": kind, "value": key} for key in keys]
        source = {"type": "key", "id": "keyboard", "actions": actions}
        self.send("input.performActions", context=self._context, actions=[source])
