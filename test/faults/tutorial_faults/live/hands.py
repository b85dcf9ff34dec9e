"""The hands on the virtual gamepad, and what they showed when."""

import threading
import time

from gamepad.gamepads import F710_D
from gamepad.virtual.controls import Controls, positions
from gamepad.virtual.pads import StreamPad
from tutorial_faults.live.plan import DRIVE, RELEASED, STICK, TURBO, TURN

PERIOD_S = 0.05  # how often they move
SHOWN = {
    RELEASED: (0.0, 0.0, ()),
    DRIVE: (0.0, 0.8, ("LB",)),
    TURN: (0.6, 0.7, ("LB",)),
    TURBO: (0.2, 0.8, ("LB", "RB")),  # LB, too: between the one and the other is a release
    STICK: (0.0, 0.8, ()),
}
NUDGE = 0.1  # the stick never rests, so that nothing is still for a reason of its own


class HandsOnPad:
    """Move the gamepad from a thread; a context manager.

    path: of the FIFO that joy_node reads.
    """

    def __init__(self, path):
        """path: of the FIFO; it is made."""
        self.path = path
        self._shown, self._plugged, self._frozen, self._is_radio = RELEASED, True, False, False
        self._wake, self._done = threading.Event(), threading.Event()
        self._lock = threading.Lock()
        self._changes = [(time.time(), RELEASED)]
        self._thread = threading.Thread(target=self._move, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._done.set()
        self._wake.set()
        self._thread.join()

    def show(self, what):
        """Show it from now on."""
        with self._lock:
            if what != self._shown:
                self._shown = what
                self._changes.append((time.time(), what))
        self._wake.set()

    def new_record(self):
        """A new list, of (time [s], what is shown from then on), which goes on growing."""
        with self._lock:
            self._changes = [(time.time(), self._shown)]
        return self._changes

    def plug(self, plugged):
        """Plug the gamepad in, or pull it out."""
        self._plugged = plugged
        self._wake.set()

    def freeze(self, frozen):
        """Stop serving the gamepad, as a program that hangs does."""
        self._frozen = frozen
        self._wake.set()

    def be_radio(self, is_radio):
        """Be a radio gamepad, whose receiver gives no sign of life; joy_node opens it anew."""
        self._is_radio = is_radio

    def _move(self):
        with StreamPad(F710_D, self.path) as pad:
            nudge = 0.0
            while not self._done.is_set():
                self._wake.wait(PERIOD_S)
                self._wake.clear()
                if self._frozen:
                    continue
                pad.gives_signs = not self._is_radio
                nudge = NUDGE - nudge
                left, forward, held = SHOWN[self._shown]
                forward += nudge if forward else 0.0
                controls = Controls(left_stick=(left, forward), held=frozenset(held))
                pad.show(positions(F710_D, controls) if self._plugged else None)
