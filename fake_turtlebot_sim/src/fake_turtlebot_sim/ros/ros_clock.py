"""The two clocks a ROS node can live by, behind one interface, and the motion that follows them.

``read()`` returns (stamp, reading): the ROS time for the messages and the time in nanoseconds that
motion and periods follow. ``wait(reading, deadline)`` returns once the clock has reached the
deadline, was set back behind the reading, or the node is shut down.
"""

from __future__ import annotations

import threading
import time
from contextlib import contextmanager
from typing import Iterator, NamedTuple

import rospy

from fake_turtlebot_sim.simulator.clock import MotionClock
from node_kit.io.suspension import Suspensions

SHUTDOWN_CHECK_S = 0.1  # how long a shutdown may go unnoticed while /clock stands still


class RealClock:
    """Stamps from the system clock; motion from the monotonic one, which nobody can set."""

    def read(self) -> tuple[rospy.Time, int]:
        return rospy.Time.now(), time.monotonic_ns()

    def wait(self, _reading_ns: int, deadline_ns: int) -> None:
        time.sleep(max(0, deadline_ns - time.monotonic_ns()) * 1e-9)


class SimulatedClock:
    """Everything from /clock, which may pause, jump forwards and be set back."""

    def read(self) -> tuple[rospy.Time, int]:
        stamp = rospy.Time.now()
        return stamp, stamp.to_nsec()

    def wait(self, reading_ns: int, deadline_ns: int) -> None:
        changed = rospy.rostime.get_rostime_cond()
        with changed:
            while (
                reading_ns <= rospy.Time.now().to_nsec() < deadline_ns and not rospy.is_shutdown()
            ):
                changed.wait(SHUTDOWN_CHECK_S)


class Instant(NamedTuple):
    """One moment, as the three clocks of the node show it."""

    stamp: rospy.Time
    reading_ns: int
    motion_ns: int  # never decreases


class MotionLock:
    """Guards the motion of all robots: a thread that holds it has them, and the present, alone."""

    def __init__(self) -> None:
        """Follow the clock that /use_sim_time asks for; the node must be initialised."""
        self.clock = RealClock() if rospy.rostime.is_wallclock() else SimulatedClock()
        self._lock = threading.Lock()
        self.suspensions = Suspensions()
        self._motion_clock = MotionClock(self.clock.read()[1])

    @contextmanager
    def hold(self) -> Iterator[Instant]:
        """Keep other threads out and yield the Instant, read inside so that all are in order."""
        with self._lock:
            stamp, reading_ns = self.clock.read()
            yield Instant(stamp, reading_ns, self._motion_clock.update(reading_ns))
