"""Records all topics for a page that may drive, with rosbag record in the cockpit's folder."""

from __future__ import annotations

import itertools
import os
import shutil
import signal
import threading
import time
from contextlib import suppress
from subprocess import DEVNULL, Popen
from typing import ClassVar, Sequence

import rospy

from cockpit_server.errors import RefusedError
from cockpit_server.pages import Page, TabSource
from cockpit_server.schema import switch

# It ends after 150 MB, as the tab Bag opens up to 200 MB, or after an hour.
COMMAND = ("rosbag", "record", "-q", "-a", "--size=150", "--duration=1h", "-O")
LEAST_FREE = 1 << 30  # bytes; rosbag records nothing with less (its --min-space)
NO_SPACE = "less than 1 GB is free in the cockpit's folder"
FULL = "150 MB or an hour are recorded"
LOOK_S = 1.0  # how often the free space is checked
# Linux sends rosbag this signal also when the thread that started it exits, as by kill -9.
ENDS_WITH_US = ("setpriv", "--pdeathsig", "INT")


class Recorder(TabSource):
    """At most one recording, which any page that may drive can start and end."""

    messages: ClassVar = {"record": {"on": switch}}

    def __init__(self) -> None:
        self._name = ""  # the file that is being recorded, or ""
        self._why = ""  # why the last recording has ended, if no page ended it
        self._next_look_s = self._began_s = 0.0
        self._process: Popen[bytes] | None = None
        self._is_over = False  # whether it was stopped, maybe before there was a process
        rospy.on_shutdown(self._stop)

    def collect(self, pages: Sequence[Page], now: float) -> None:
        if self._process and now >= self._next_look_s:
            self._next_look_s = now + LOOK_S
            if not has_space():
                self._why = f"{self._name} has ended: {NO_SPACE}"
                self._stop()

    def send_to(self, page: Page, now: float) -> None:
        seconds = int(now - self._began_s) if self._name else 0
        state = {"name": self._name, "why": self._why, "seconds": seconds}
        if page.watch.bag and page.take_if_new("recorder", state):
            page.send("recorder", **state)

    def on_record(self, page: Page, now: float, on: bool) -> None:
        page.must_drive()
        if not on:
            self._stop()
        elif self._name:
            raise RefusedError(f"{self._name} is being recorded")
        elif not has_space():
            raise RefusedError(f"{NO_SPACE}, and rosbag needs more")
        else:
            self._name, self._why, self._is_over = free_name(), "", False
            self._began_s = now
            threading.Thread(target=self._record, daemon=True).start()

    def _record(self) -> None:
        command = [*ENDS_WITH_US, *COMMAND, self._name]
        self._process = Popen(command, start_new_session=True, stdin=DEVNULL, stdout=DEVNULL)
        if self._is_over:
            self._stop()
        code = self._process.wait()
        if not self._is_over:
            why = f"rosbag record has failed ({code})" if code else FULL
            self._why = f"{self._name} has ended: {why if has_space() else NO_SPACE}"
        if code and not os.path.exists(self._name):
            rospy.logwarn("cockpit: rosbag record cannot write %s here", self._name)
        self._process, self._name = None, ""

    def _stop(self) -> None:
        self._is_over, process = True, self._process
        if process and process.poll() is None:
            with suppress(ProcessLookupError):  # It has just exited.
                os.killpg(process.pid, signal.SIGINT)


def has_space() -> bool:
    return shutil.disk_usage(".").free >= LEAST_FREE


def free_name() -> str:
    """Return an unused file name with the time, and a number within the same second."""
    base = time.strftime("page_%Y-%m-%d-%H-%M-%S")
    names = (f"{base}{f'_{n}' if n else ''}.bag" for n in itertools.count())
    return next(n for n in names if not os.path.exists(n) and not os.path.exists(f"{n}.active"))
