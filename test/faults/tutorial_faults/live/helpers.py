"""Helper programs of the hunt, and a heartbeat that reports when this process was not run."""

import subprocess
import sys
import threading
import time

PYTHON = "/usr/bin/python3"  # ROS's own
BEAT_S = 0.01
LATE_S = 0.1  # a gap worth a report


def beat(late):
    """Call late(time of the system clock [s], gap [s]) after each gap; return how to end it."""
    done = threading.Event()

    def go():
        before = time.monotonic()
        while not done.wait(BEAT_S):
            now = time.monotonic()
            if now - before > LATE_S:
                late(time.time(), now - before)
            before = now

    threading.Thread(target=go, daemon=True).start()
    return done.set


class Helper:
    """A program of this folder that reads and prints lines; a context manager that ends it."""

    def __init__(self, module, *arguments, environment=None, hear=None):
        """module: of this package. hear: called with each line that it prints."""
        self._process = subprocess.Popen(
            [PYTHON, "-m", f"tutorial_faults.live.{module}", *map(str, arguments)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            text=True, env=environment, start_new_session=True,
        )  # fmt: skip
        self._ready = threading.Event()
        self._hear = hear
        threading.Thread(target=self._listen, daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.kill()
        self._process.wait()

    @property
    def pid(self):
        """Its process."""
        return self._process.pid

    def write(self, *words):
        """Write a line to it."""
        try:
            self._process.stdin.write(" ".join(map(str, words)) + "\n")
            self._process.stdin.flush()
        except OSError:
            print(f"faults: {self._process.args[-1]} has exited", file=sys.stderr)

    def wait_ready(self, deadline_s=120.0):
        """Wait for its line `ready`. Raises TimeoutError."""
        end = time.monotonic() + deadline_s
        while not self._ready.wait(0.1):
            if self._process.poll() is not None or time.monotonic() > end:
                raise TimeoutError(f"{' '.join(self._process.args)} is not ready")

    def _listen(self):
        for line in self._process.stdout:
            if line == "ready\n":
                self._ready.set()
            elif self._hear:
                self._hear(line)
