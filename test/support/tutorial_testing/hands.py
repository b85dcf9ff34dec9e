"""Hands on a virtual F710, and a record of their positions."""

import threading
import time

import rosbag
import rospy
from sensor_msgs.msg import Joy

from gamepad.gamepads import F710_D
from gamepad.io.pads import StreamPad
from gamepad.virtual.controls import Controls, positions

DRIVE, TURN, TURBO, STICK, RELEASED = "drive", "turn", "turbo", "stick", "released"
SHOWN = {  # turn and forward of the left stick, buttons that are held
    RELEASED: (0.0, 0.0, ()),
    DRIVE: (0.0, 0.8, ("LB",)),
    TURN: (0.6, 0.7, ("LB",)),
    TURBO: (0.2, 0.8, ("LB", "RB")),  # with LB: a change from LB to RB would be a release
    STICK: (0.0, 0.8, ()),
}
PERIOD_S = 0.05  # how often they move
NUDGE = 0.1  # the stick is never still, so that the vigilance timeout does not stop the robot


def record(path):
    """Write a bag of 6 s in which LB and the stick are held for 1.6 s, at full deflection."""
    with rosbag.Bag(path, "w") as bag:
        for k in range(300):  # at rest until all nodes are connected
            held = int(200 <= k < 280)
            joy = Joy(axes=[0.0, held, 0.0, 0.0, 0.0, 0.0], buttons=[0] * 4 + [held] + [0] * 7)
            bag.write("/joy", joy, rospy.Time(1 + k / 50))
    return path


class Hands:
    """Move the gamepad from a thread; a context manager."""

    def __init__(self, path):
        """path: of the FIFO that joy_node reads, which this creates."""
        self._path = path
        self._shown, self._plugged, self._frozen, self._is_radio = RELEASED, True, False, False
        self._wake, self._done, self._lock = threading.Event(), threading.Event(), threading.Lock()
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
        """Hold a position, a key of SHOWN, from now on."""
        with self._lock:
            if what != self._shown:
                self._shown = what
                self._changes.append((time.time(), what))
        self._wake.set()

    def new_record(self):
        """Return a new list of (time [s], position from then on), which grows with each change."""
        with self._lock:
            self._changes = [(time.time(), self._shown)]
        return self._changes

    def plug(self, plugged):
        self._plugged = plugged
        self._wake.set()

    def freeze(self, frozen):
        """Stop serving the gamepad, as a program that hangs does."""
        self._frozen = frozen
        self._wake.set()

    def be_radio(self, is_radio):
        """Act as a radio gamepad, whose receiver sends no signs of life."""
        self._is_radio = is_radio

    def _move(self):
        with StreamPad(F710_D, self._path) as pad:
            nudge = 0.0
            while not self._done.is_set():
                self._wake.wait(PERIOD_S)
                self._wake.clear()
                if self._frozen:
                    continue
                pad.gives_signs = not self._is_radio
                nudge = NUDGE - nudge
                turn, forward, held = SHOWN[self._shown]
                forward += nudge if forward else 0.0
                controls = Controls(left_stick=(turn, forward), held=frozenset(held))
                pad.show(positions(F710_D, controls) if self._plugged else None)
