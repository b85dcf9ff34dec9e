"""A workspace whose checks are made here, while a worker records in isolation."""

from __future__ import annotations

import os
import shlex
from pathlib import Path
from typing import Any, Callable, Dict

from tutorial_check.isolation.bubblewrap import SYSTEM
from tutorial_check.model import (
    MASTER_GONE,
    MULTIPLIES,
    UNREADABLE,
    CannotCheck,
    Result,
    Wrong,
    master_gone,
)
from tutorial_check.order import Order
from tutorial_check.record.recording import as_json, from_json, recorded_by
from tutorial_check.record.session import Memory, Recorded, Recorder, Session, once
from tutorial_check.source.manifests import unreadable
from tutorial_check.source.workspace import COPY, Layout

Ask = Callable[[Dict[str, Any]], Dict[str, Any]]  # the worker: question -> answer


class Case(Session):
    """What the files of a workspace say, as they were handed in, and what the worker records."""

    def __init__(self, order: Order, task: Any, ask: Ask) -> None:
        layout = Layout(Path(order.root), Path(order.source), order.is_workspace)
        super().__init__(
            order.folder,
            layout,
            order.exercises,
            underlay=order.underlay,
            underlay_environment=order.environment,
            task=task,
        )
        self.source = self.folder / COPY
        visible = (str(self.source), *order.shown, *SYSTEM)
        self._visible = [Path(os.path.realpath(each)) for each in visible]
        self._order, self._ask = order, ask
        self._runs: Memory = {}
        self.asked: list[dict[str, Any]] = []  # each question with its answer
        self._strained = self._hopeless = False

    def recording(self, recorder: Recorder[Recorded], *arguments: object) -> Recorded:
        """Ask for a recording, at the first call. Raises CannotCheck, or Wrong if there can be none."""
        key = recorder.__module__, recorder.__name__, *arguments
        found: Recorded = once(self._runs, key, lambda: self._asked(recorder, arguments))
        return found

    def _asked(self, recorder: Recorder[Recorded], arguments: tuple[object, ...]) -> Recorded:
        name = f"{recorder.__module__}:{recorder.__name__}"
        question = {"recorder": name, "arguments": as_json(arguments)}
        answer = self._ask(question)
        self.asked.append({**question, **answer})
        self._strained = bool(answer.get("strained"))
        self._hopeless = bool(answer.get("hopeless"))
        if "cannot" in answer:
            raise CannotCheck(str(answer["cannot"]))
        if "cut_short" in answer:
            raise self._why_cut_short(**answer["cut_short"])
        return from_json(recorded_by(recorder), answer["recording"])

    def _why_cut_short(self, kind: str, seen: str) -> Wrong:
        if kind == UNREADABLE and self.broken:
            return unreadable(self.broken)
        if kind == MASTER_GONE:
            return master_gone()
        if kind == MULTIPLIES:
            seen, hint = (
                f"it starts itself again and again: {seen}",
                "where does it call os.fork, or start programs?",
            )
            return Wrong("a program that is one process, or a few", seen, hint=hint, sure=True)
        hint = "look at the first line of the file: #!/usr/bin/env python3"
        return Wrong("a program that can be started", seen, hint=hint)

    def second_look(self, explained: bool) -> bool:
        """Return whether to look again at what programs do; then forget what they did.

        It is worth it if the machine was busy, or if no line explains it: nodes of a launch file meet
        in any order; and a Ctrl-C that meets rospy in the middle of a publish of the main thread may
        wait without end for a lock of that thread.
        """
        if explained and not self._strained:
            return False
        self._runs.clear()
        return True

    def too_busy(self) -> bool:
        """Return whether what was recorded last proves nothing: the programs had too little time."""
        return self._hopeless

    def as_sent(self, result: Result) -> Result:
        """Return a result with the student's own paths."""
        order = self._order
        copied = f"{self.source.parent}/" if order.is_workspace else f"{self.source}/"
        # Commands work in any folder, where the workspace is known.
        is_known = order.own and self.folder not in self.layout.root.parents
        root = f"{shlex.quote(order.root)}/" if is_known else ""
        found = dict(vars(result))
        for name, words in found.items():
            if isinstance(words, str):
                found[name] = words.replace(copied, root if name in ("hint", "look") else "")
        return Result(**found)
