"""A diagnosis as a row of data: a condition on recorded facts, what was seen, where, what to do. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Iterable

from tutorial_check.model import Wrong


@dataclass(frozen=True)
class Row:
    """One diagnosis. Its texts are formats of the facts, `{f.name}`, and of what when() `{found}`."""

    when: Callable[[Any], Any]  # facts -> what is found; anything false: the row does not apply
    seen: str
    hint: str = ""
    where: str = ""
    sure: bool = False  # whatever else the machine had to do, it is no matter of time


def first(rows: Iterable[Row], facts: Any, expected: str = "") -> Wrong | None:
    """Return the Wrong of the first row that applies to the facts, or None."""
    for row in rows:
        found = row.when(facts)
        if found:
            seen, hint, where = (
                text.format(f=facts, found=found) for text in (row.seen, row.hint, row.where)
            )
            return Wrong(expected, seen, where=where, hint=hint, sure=row.sure)
    return None
