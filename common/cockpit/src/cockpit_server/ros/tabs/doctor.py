"""The tab Doctor: the lines of the doctor while it runs."""

from __future__ import annotations

import math
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any, ClassVar

import rospkg

from cockpit_server.pages import Page, TabSource
from cockpit_server.tabs.logs import doctor_line

COMMAND = "nice", "timeout", "60"  # s
FRESH_S = 10.0  # a viewer receives lines of this age without a new run


class Doctor(TabSource):
    """The doctor, which runs when a page asks for it, once at a time, and its lines for pages."""

    messages: ClassVar = {"doctor": {}}

    def __init__(self) -> None:
        self._output: dict[str, Any] = {}  # what pages receive of the newest run
        self._ended_at = -math.inf  # [s] end of the last run

    def send_to(self, page: Page, now: float) -> None:
        if self._output and page.take_if_new("doctor", self._output):
            page.send("doctor", **self._output)

    def on_doctor(self, page: Page, now: float) -> None:
        page.seen.pop("doctor", None)  # The page receives an answer even if it is the same.
        may = page.drives or now - self._ended_at > FRESH_S
        if may and not self._output.get("running"):
            self._output = {"lines": [], "running": True}
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
        except Exception as error:  # whatever prevents it; the next run may succeed
            self._add(f"wrong doctor {type(error).__name__}: {error}")
        finally:
            self._output, self._ended_at = {**self._output, "running": False}, time.monotonic()

    def _add(self, line: str) -> None:
        self._output = {**self._output, "lines": [*self._output["lines"], doctor_line(line)]}
