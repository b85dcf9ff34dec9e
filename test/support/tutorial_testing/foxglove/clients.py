"""Clients with npm's @foxglove/ws-protocol, in one process of Node: client.mjs."""

from __future__ import annotations

import json
import subprocess
import threading
from pathlib import Path

from tutorial_testing.npm import modules
from tutorial_testing.waiting import wait_for

PROGRAM = Path(__file__).with_name("client.mjs")
LICHTBLICK = ("foxglove.websocket.v1",)  # the subprotocols that it offered until 2025
FOXGLOVE = ("foxglove.sdk.v1", "foxglove.websocket.v1")


class Clients:
    """A process whose connections have names."""

    def __init__(self, url: str) -> None:
        self._url, self.events = url, []
        command = ["node", str(PROGRAM), str(modules())]
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
        )
        threading.Thread(target=self._read, daemon=True).start()

    def __enter__(self) -> Clients:
        return self

    def __exit__(self, *_) -> None:
        self._process.stdin.close()
        self._process.wait()

    def kill(self) -> None:
        """End all connections without a word to the server."""
        self._process.kill()

    def connect(self, name: str = "", protocols: tuple = LICHTBLICK) -> Client:
        """Return a client, once it is connected."""
        client = Client(self, name)
        client.do("connect", url=self._url, protocols=protocols)
        wait_for(lambda: client.of("open") or client.of("error"), f"client {name}")
        assert client.of("open"), client.of("error")
        return client

    def say(self, command: dict) -> None:
        self._process.stdin.write(json.dumps(command) + "\n")

    def _read(self) -> None:
        for line in self._process.stdout:
            self.events.append(json.loads(line))


class Client:
    """A connection; what it receives is in the events."""

    def __init__(self, clients: Clients, name: str) -> None:
        self._clients, self._name = clients, name

    def do(self, command: str, **content: object) -> None:
        """Send a command of client.mjs."""
        self._clients.say({"name": self._name, "command": command, **content})

    def of(self, event: str) -> list[dict]:
        """Return its events of this kind until now."""
        events = list(self._clients.events)
        return [it for it in events if it["event"] == event and it["name"] == self._name]

    def next(self, event: str, command: str, **content: object) -> dict:
        """Send a command; return the next event of this kind."""
        number = len(self.of(event))
        self.do(command, **content)
        return wait_for(lambda: self.of(event)[number:], f"{event} after {command}")[0]

    def channels(self) -> dict[str, dict]:
        """Return {topic: channel} of what the server has advertised."""
        return {it["topic"]: it for event in self.of("advertise") for it in event["data"]}

    def messages(self, topic: str) -> list[dict]:
        return [it for it in self.of("message") if it["topic"] == topic]
