"""The doctor's lines, as pages get them while it runs."""

from __future__ import annotations

import math
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import ClassVar

import rospkg

from cockpit_server.clients import Client, Source
from cockpit_server.sources.logs import without_folders

COMMAND = "nice", "timeout", "60"  # s
FRESH_S = 10.0  # a viewer gets lines of this age, without a new run


def shown(line: str) -> dict[str, str]:
    """Return a line of the doctor as pages get it."""
    level, subject, text = [*line.split(maxsplit=2), "", "", ""][:3]
    if level not in ("ok", "wrong", "unknown"):
        subject, text = "", line
    level = level if level in ("ok", "wrong") else "note"
    return {"level": level, "subject": subject, "text": without_folders(text.strip())}


class Doctor(Source):
    """Runs the doctor when a page asks for it, once at a time, and sends its lines to all pages."""

    messages: ClassVar = {"doctor": {}}

    def __init__(self) -> None:
        self._lines: list[dict[str, str]] = []
        self._running, self._version = False, 0
        self._ended_at = -math.inf  # [s] end of the last run

    def send_to(self, client: Client, now: float) -> None:
        if self._version and client.take_if_new("doctor", self._version):
            client.send("doctor", lines=self._lines, running=self._running)

    def on_doctor(self, client: Client, now: float) -> None:
        may = client.drives or now - self._ended_at > FRESH_S
        if not may:
            client.seen.pop("doctor", None)
        if may and not self._running:
            self._running, self._lines = True, []
            self._version += 1
            threading.Thread(target=self._run, daemon=True).start()

    def _run(self) -> None:
        try:
            self._listen()
        except Exception as error:  # whatever keeps it from running; the next run may go well
            self._lines = [*self._lines, shown(f"wrong doctor {type(error).__name__}: {error}")]
        finally:
            self._running, self._ended_at = False, time.monotonic()
            self._version += 1

    def _listen(self) -> None:
        script = Path(rospkg.RosPack().get_path("tutorial_tools")) / "scripts" / "doctor.py"
        with subprocess.Popen(
            [*COMMAND, sys.executable, str(script)], stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
        ) as program:  # fmt: skip
            for line in program.stdout or ():
                self._lines = [*self._lines, shown(line)]
                self._version += 1
