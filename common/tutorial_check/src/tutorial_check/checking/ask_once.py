"""Lets two workers of one workspace record side by side, and each thing once."""

from __future__ import annotations

import contextlib
import json
from concurrent.futures import CancelledError, Future
from pathlib import Path
from typing import Callable, Dict

from tutorial_check.submission.order import Line

Ask = Callable[[Line], Line]  # the worker: question -> answer
Answers = Dict[str, "Future[str]"]  # by question: JSON, with HANDED_IN
HANDED_IN = "{handed_in}"  # in recordings: the folder with the copy of the workspace


class AskOnce:
    """Asks one of two workers of a workspace, unless the other one was asked the same before."""

    def __init__(self, ask: Ask, folder: Path, shared: Answers) -> None:
        """folder: of this worker's order. shared: what either was asked."""
        self._ask, self._folder, self._shared = ask, str(folder), shared
        self._asked: set[str] = set()  # The same a second time is a second look.

    def __call__(self, question: Line) -> Line:
        key = json.dumps(question)
        own: Future[str] = Future()
        first = self._shared.setdefault(key, own)
        if first is not own and key not in self._asked:
            self._asked.add(key)
            with contextlib.suppress(CancelledError):  # The other one has ended.
                return dict(json.loads(first.result().replace(HANDED_IN, self._folder)))
        self._asked.add(key)
        try:
            answer = self._ask(question)
        except BaseException:
            own.cancel()
            raise
        own.set_result(json.dumps(answer).replace(self._folder, HANDED_IN))
        return answer
