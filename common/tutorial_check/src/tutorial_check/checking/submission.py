"""A submission that is examined: its files, and recordings of its programs."""

from __future__ import annotations

import os
import re
import shlex
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable, cast

from node_kit.printable import quotable
from tutorial_check.checking.manifest_errors import unreadable
from tutorial_check.checking.results import Result, Wrong, wrong_of
from tutorial_check.course.tasks import Task
from tutorial_check.data.json_data import as_json, from_json
from tutorial_check.data.recorders import BUILT, RecorderName, Recording, name_of
from tutorial_check.data.recordings import Executable
from tutorial_check.errors import UNREADABLE, CannotCheck
from tutorial_check.sandbox.environment import SYSTEM
from tutorial_check.submission import handed_in
from tutorial_check.submission.order import Ask, Order, Question, Reply
from tutorial_check.submission.submission_files import SubmissionFiles

SCRIPT = re.compile(r"\b(\w+)\.py\b")


class Submission(SubmissionFiles):
    """The files of a workspace as they were handed in, and what the worker records."""

    def __init__(self, order: Order, task: Task, ask: Ask) -> None:
        super().__init__(order, task)
        self.source = self.folder / handed_in.COPY
        visible = [self.source, *order.sandbox.readable, *map(Path, SYSTEM)]
        self._visible = [Path(os.path.realpath(path)) for path in visible]
        self._ask = ask
        self._runs: dict[object, Any] = {}  # what was recorded, or the Wrong instead
        self.exchanges: list[dict[str, object]] = []  # questions with their replies, as JSON
        self._last = Reply()

    def recording(
        self, recorder: Callable[..., Recording] | RecorderName[Recording], *arguments: object
    ) -> Recording:
        """Return a recording, made at the first call. Raises CannotCheck, or Wrong if it failed."""
        named = recorder if isinstance(recorder, RecorderName) else name_of(recorder)
        key = named.name, *arguments
        if key not in self._runs:
            self._runs[key] = self._recorded(named, arguments)
        if isinstance(self._runs[key], Wrong):
            raise self._runs[key]
        return cast(Recording, self._runs[key])

    @property
    def executables(self) -> tuple[Executable, ...]:
        return self.recording(BUILT).executables

    def with_names(self, text: str) -> str:
        """Return a title or command that has talker.py with talker, if that is in C++."""
        names = list(filter(self.has, self.course.packages))
        if not any(map(self.is_in_cpp, names)):
            return text
        in_python = [name for name in names if not self.is_in_cpp(name)]
        scripts = {Path(path).name for name in in_python for path in self.scripts(name)}
        return SCRIPT.sub(lambda name: name[0] if name[0] in scripts else name[1], text)

    def _recorded(self, named: RecorderName[Any], arguments: tuple[object, ...]) -> object:
        question = Question(named.name, arguments)
        self._last = self._ask(question)
        exchange = {**vars(question), **vars(self._last)}
        self.exchanges.append({k: as_json(v) for k, v in exchange.items() if v is not None})
        reply = self.places.whole(self._last)
        if reply.cannot:
            raise CannotCheck(str(reply.cannot))
        if reply.cut_short:
            if reply.cut_short.kind == UNREADABLE and self.broken:
                return unreadable(self.broken)
            return wrong_of(reply.cut_short)
        return from_json(named.kind, reply.recording)

    def busy(self) -> bool:
        """Return whether the machine was busy during the last recording."""
        return self._last.busy

    def overloaded(self) -> bool:
        """Return whether the machine was too busy for the last recording to mean anything."""
        return self._last.overloaded

    def forget_recordings(self) -> None:
        self._runs.clear()

    def as_sent(self, result: Result) -> Result:
        """Return a result with the student's own paths, in characters that a terminal may show."""
        layout = self.layout
        copied = f"{self.source.parent}/" if layout.is_workspace else f"{self.source}/"
        # If the workspace is known, commands work in any folder.
        is_known = self.order.is_callers_own and self.folder not in layout.root.parents
        root = f"{shlex.quote(str(layout.root))}/" if is_known else ""
        roots = {"hint": root, "look": root}
        texts: dict[str, Any] = {
            name: quotable(words.replace(copied, roots.get(name, "")))
            for name, words in vars(result).items()
            if isinstance(words, str)
        }
        return replace(result, **texts)
