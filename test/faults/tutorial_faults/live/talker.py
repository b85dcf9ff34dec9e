"""A helper program that is told by lines on its standard input, and tells lines itself."""

import subprocess
import sys
import threading
import time

PYTHON = "/usr/bin/python3"  # ROS's own


class Talker:
    """Such a program of this package, as long as this context lasts; it ends with its input."""

    def __init__(self, module, *arguments, prefix=(), environment=None, hear=None):
        """module: of tutorial_faults.live. prefix: of its command. hear: called with each line."""
        self._process = subprocess.Popen(
            [*prefix, PYTHON, "-m", f"tutorial_faults.live.{module}", *map(str, arguments)],
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

    @property
    def ended(self):
        """Whether it has ended."""
        return self._process.poll() is not None

    def tell(self, *words):
        """Tell it a line; one that has ended hears nothing."""
        try:
            self._process.stdin.write(" ".join(map(str, words)) + "\n")
            self._process.stdin.flush()
        except OSError:
            print(f"faults: {self._process.args[-1]} has ended", file=sys.stderr)

    def wait_ready(self, deadline_s=120.0):
        """Wait until it has told the line `ready`. Raises TimeoutError."""
        end = time.monotonic() + deadline_s
        while not self._ready.wait(0.1):
            if self.ended or time.monotonic() > end:
                what = "has ended" if self.ended else "is not ready"
                raise TimeoutError(f"{' '.join(self._process.args)} {what}")

    def _listen(self):
        for line in self._process.stdout:
            if line == "ready\n":
                self._ready.set()
            elif self._hear:
                self._hear(line)
