"""The workspace that recorders get, and the ROS sessions in which its programs run."""

from __future__ import annotations

import contextlib
from typing import Iterator

from tutorial_check.errors import MASTER_GONE, UNREADABLE, CannotCheck, CutShort
from tutorial_check.recording.builder import Builder
from tutorial_check.recording.ros_session import RosSession

EXIT_S = 1.0  # a master that is killed together with the peer has this long to exit


class Workspace(Builder):
    """A workspace whose programs can be started."""

    @contextlib.contextmanager
    def ros_session(self, renamed: bool = True) -> Iterator[RosSession]:
        """Yield a RosSession, and end it. renamed: topics have the names of the student's task."""
        if self.broken:
            raise CutShort(UNREADABLE)
        self.runner.clock.begin()
        ros = RosSession(self, renamed)
        try:
            yield ros
        except (CannotCheck, CutShort, LookupError) as error:
            if isinstance(error, CannotCheck):  # The peer has ended, perhaps with the master.
                ros.wait(lambda: not ros.master_lives, EXIT_S)
            if ros.master_lives:
                raise
            raise CutShort(MASTER_GONE) from error
        finally:
            ros.end()
