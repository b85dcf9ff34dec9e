"""Where recorders work: a workspace, and stages on which its programs run."""

from __future__ import annotations

import contextlib
from typing import Iterator

from tutorial_check.processes.errors import MASTER_GONE, UNREADABLE, CannotCheck, CutShort
from tutorial_check.recording.builder import Builder
from tutorial_check.recording.ros_session import Stage

EXIT_S = 1.0  # a master that is killed together with the driver has this long to exit


class Ground(Builder):
    """A workspace whose programs can be started."""

    @contextlib.contextmanager
    def stage(self, renamed: bool = True) -> Iterator[Stage]:
        """Yield a Stage, all ends with it; renamed: topics are called as in the student's task."""
        if self.broken:
            raise CutShort(UNREADABLE)
        self.runner.clock.begin()
        stage = Stage(self, renamed)
        try:
            yield stage
        except (CannotCheck, CutShort, LookupError) as error:
            if isinstance(error, CannotCheck):  # A driver has ended, maybe with its master.
                stage.wait(lambda: not stage.master_lives, EXIT_S)
            if stage.master_lives:
                raise
            raise CutShort(MASTER_GONE) from error
        finally:
            stage.end()
