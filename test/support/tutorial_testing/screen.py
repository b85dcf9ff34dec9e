"""A virtual screen, for tests of windows."""

import contextlib
import os
import subprocess


@contextlib.contextmanager
def virtual_screen(width, height):
    """Yield the name of a virtual screen of this size [pixels], on a free display number."""
    read, write = os.pipe()
    # Without noreset it restarts when its last client leaves, and refuses others for a moment.
    command = ["Xvfb", "-displayfd", str(write), "-noreset", "-nolisten", "tcp"]
    command += ["-screen", "0", f"{width}x{height}x24"]
    with subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL) as server:
        os.close(write)
        with os.fdopen(read) as said:
            yield f":{said.readline().strip()}"
        server.terminate()
