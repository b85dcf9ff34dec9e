"""The doctor's lines, as pages get them while it runs."""

from __future__ import annotations

import math
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any, ClassVar

import rospkg

from cockpit_server.clients import Client, Source
from cockpit_server.ros.sources.logs import without_folders

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
        self._said: dict[str, Any] = {}  # what pages get of the newest run
        self._ended_at = -math.inf  # [s] end of the last run

    def send_to(self, client: Client, now: float) -> None:
        if self._said and client.take_if_new("doctor", self._said):
            client.send("doctor", **self._said)

    def on_doctor(self, client: Client, now: float) -> None:
        client.seen.pop("doctor", None)  # It gets an answer even if that has not changed.
        may = client.drives or now - self._ended_at > FRESH_S
        if may and not self._said.get("running"):
            self._said = {"lines": [], "running": True}
            threading.Thread(target=self._run, daemon=True).start()

    def _run(self) -> None:
        try:
            script = Path(rospkg.RosPack().get_path("tutorial_tools")) / "scripts" / "doctor.py"
            with subprocess.Popen(
                [*COMMAND, sys.executable, str(script)], stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
            ) as program:  # fmt: skip
                for line in program.stdout or ():
                    self._add(line)
        except Exception as error:  # whatever keeps it from running; the next run may go well
            self._add(f"wrong doctor {type(error).__name__}: {error}")
        finally:
            self._said, self._ended_at = {**self._said, "running": False}, time.monotonic()

    def _add(self, line: str) -> None:
        self._said = {**self._said, "lines": [*self._said["lines"], shown(line)]}
