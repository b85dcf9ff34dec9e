"""Records all topics for a page that may drive: rosbag record, in the cockpit's folder."""

from __future__ import annotations

import os
import signal
import threading
import time
from contextlib import suppress
from subprocess import DEVNULL, Popen
from typing import ClassVar

import rospy

from cockpit_server.clients import Client, RefusedError, Source
from cockpit_server.schema import switch

# It ends at 150 MB, as Bag opens up to 200 MB, or after an hour.
COMMAND = ("rosbag", "record", "-q", "-a", "--size=150", "--duration=1h", "-O")
# Linux sends rosbag this signal, too, once the thread that started it has gone, as by kill -9.
ENDS_WITH_US = ("setpriv", "--pdeathsig", "INT")


class Recorder(Source):
    """At most one recording, which any page that may drive starts and ends."""

    messages: ClassVar = {"record": {"on": switch}}

    def __init__(self) -> None:
        self._name = ""  # It names the file while something is recorded.
        self._process: Popen[bytes] | None = None
        self._is_over = False  # It was stopped, maybe before there was a process.
        rospy.on_shutdown(self._stop)

    def send_to(self, client: Client, now: float) -> None:
        if client.watch.bag and client.take_if_new("recorder", self._name):
            client.send("recorder", name=self._name)

    def on_record(self, client: Client, _now: float, on: bool) -> None:
        client.must_drive()
        if not on:
            self._stop()
        elif self._name:
            raise RefusedError(f"{self._name} is being recorded")
        else:
            self._name, self._is_over = time.strftime("page_%Y-%m-%d-%H-%M-%S.bag"), False
            threading.Thread(target=self._record, daemon=True).start()

    def _record(self) -> None:
        command = [*ENDS_WITH_US, *COMMAND, self._name]
        self._process = Popen(command, start_new_session=True, stdin=DEVNULL, stdout=DEVNULL)
        if self._is_over:
            self._stop()
        if self._process.wait() and not os.path.exists(self._name):
            rospy.logwarn("cockpit: rosbag record cannot write %s here", self._name)
        self._process, self._name = None, ""

    def _stop(self) -> None:
        self._is_over, process = True, self._process
        if process and process.poll() is None:
            with suppress(ProcessLookupError):  # it has just ended
                os.killpg(process.pid, signal.SIGINT)
