"""Records all topics for a page that may drive: rosbag record, in the cockpit's folder."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
import time
from contextlib import suppress
from typing import Any, ClassVar

import rospy

from cockpit_server.clients import Client, Source
from cockpit_server.driver_session import RefusedError
from cockpit_server.schema import switch

LARGEST_MB, LONGEST = 150, "1h"  # then it ends; Bag opens up to 200 MB
COMMAND = ("rosbag", "record", "-q", "-a", f"--size={LARGEST_MB}", f"--duration={LONGEST}", "-O")


class Recorder(Source):
    """At most one recording, which any page that may drive starts and ends."""

    messages: ClassVar = {"record": {"on": switch}}

    def __init__(self) -> None:
        self._name = ""  # of the file that is being recorded
        self._process: Any = None
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
            self._name = time.strftime("page_%Y-%m-%d-%H-%M-%S.bag")
            threading.Thread(target=self._record, args=(self._name,), daemon=True).start()

    def _record(self, name: str) -> None:
        streams = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL}
        try:
            self._process = subprocess.Popen([*COMMAND, name], start_new_session=True, **streams)
            code = self._process.wait()
            if code and not os.path.exists(name):
                rospy.logwarn("cockpit: rosbag record cannot write %s here", name)
        except OSError as error:
            rospy.logwarn("cockpit: rosbag record: %s", error.strerror)
        finally:
            self._process, self._name = None, ""

    def _stop(self) -> None:
        process = self._process
        if process and process.poll() is None:
            with suppress(ProcessLookupError):  # it has just ended
                os.killpg(process.pid, signal.SIGINT)
