"""Let two workers of one workspace record side by side without repeating each other."""

from __future__ import annotations

import contextlib
import json
from concurrent.futures import CancelledError, Future
from typing import Dict

from tutorial_check.data.json_data import as_json
from tutorial_check.submission.order import Ask, Question, Reply

Replies = Dict[str, "Future[Reply]"]  # by question: JSON


class AskOnce:
    """Asks one of two workers of a workspace, unless the other was asked the same before."""

    def __init__(self, ask: Ask, shared: Replies) -> None:
        """shared: replies of both."""
        self._ask, self._shared = ask, shared
        self._before: set[str] = set()  # Asking again means that another recording is wanted.

    def __call__(self, question: Question) -> Reply:
        key = json.dumps(as_json(question))
        own: Future[Reply] = Future()
        first = self._shared.setdefault(key, own)
        is_first = key not in self._before
        self._before.add(key)
        if first is not own and is_first:
            with contextlib.suppress(CancelledError):  # The other worker has ended.
                return first.result()
        try:
            reply = self._ask(question)
        except BaseException:
            own.cancel()
            raise
        own.set_result(reply)
        return reply
