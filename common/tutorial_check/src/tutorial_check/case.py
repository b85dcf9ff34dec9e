"""A workspace whose checks are made here, while a worker records in isolation."""

from __future__ import annotations

import os
import shlex
from pathlib import Path
from typing import Any, Callable, cast

from tutorial_check.isolation.bubblewrap import SYSTEM
from tutorial_check.model import UNREADABLE, CannotCheck, CutShort, Result, Wrong
from tutorial_check.order import Line, Order
from tutorial_check.record.recording import as_json, from_json, recorded_by
from tutorial_check.record.session import Recorded, Recorder, Session
from tutorial_check.source.manifests import unreadable
from tutorial_check.source.workspace import COPY
from tutorial_check.variants import Task

Ask = Callable[[Line], Line]  # the worker: question -> answer


class Case(Session):
    """What the files of a workspace say, as they were handed in, and what the worker records."""

    def __init__(self, order: Order, task: Task, ask: Ask) -> None:
        super().__init__(order, task)
        self.source = self.folder / COPY
        visible = [self.source, *order.shown, *map(Path, SYSTEM)]
        self._visible = [Path(os.path.realpath(each)) for each in visible]
        self._ask = ask
        self._runs: dict[object, Any] = {}  # what was recorded, or the Wrong in its place
        self.asked: list[Line] = []  # each question with its answer
        self._strained = self.hopeless = False  # the machine was, as something was recorded last

    def recording(self, recorder: Recorder[Recorded], *arguments: object) -> Recorded:
        """Ask for a recording, at the first call. Raises CannotCheck, or Wrong if there can be none."""
        key = recorder.__module__, recorder.__name__, *arguments
        if key not in self._runs:
            try:
                self._runs[key] = self._asked(recorder, arguments)
            except Wrong as wrong:
                self._runs[key] = wrong
        if isinstance(self._runs[key], Wrong):
            raise self._runs[key]
        return cast(Recorded, self._runs[key])

    def _asked(self, recorder: Recorder[Recorded], arguments: tuple[object, ...]) -> Recorded:
        name = f"{recorder.__module__}:{recorder.__name__}"
        question = {"recorder": name, "arguments": as_json(arguments)}
        answer = self._ask(question)
        self.asked.append({**question, **answer})
        self._strained = bool(answer.get("strained"))
        self.hopeless = bool(answer.get("hopeless"))
        if "cannot" in answer:
            raise CannotCheck(str(answer["cannot"]))
        if "cut_short" in answer:
            end = CutShort(**answer["cut_short"])
            if end.kind == UNREADABLE and self.broken:
                raise unreadable(self.broken)
            raise end.as_wrong()
        return from_json(recorded_by(recorder), answer["recording"])

    def second_look(self, explained: bool) -> bool:
        """Return whether to look again at what programs do; then forget what they did.

        It is worth it on a busy machine, or if no line explains it: nodes of a launch file meet in
        any order, and rospy may never end that Ctrl-C meets in the middle of a publish.
        """
        if explained and not self._strained:
            return False
        self._runs.clear()
        return True

    def as_sent(self, result: Result) -> Result:
        """Return a result with the student's own paths."""
        layout = self.layout
        copied = f"{self.source.parent}/" if layout.is_workspace else f"{self.source}/"
        # Commands work in any folder, where the workspace is known.
        is_known = self.order.own and self.folder not in layout.root.parents
        root = f"{shlex.quote(str(layout.root))}/" if is_known else ""
        roots = {"hint": root, "look": root}
        found: dict[str, Any] = {
            name: words.replace(copied, roots.get(name, "")) if isinstance(words, str) else words
            for name, words in vars(result).items()
        }
        return Result(**found)
