"""A diagnosis as a row of data: a condition on recorded facts, what was seen, hint, where. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Iterable

from tutorial_check.checking.results import Note, Wrong


@dataclass(frozen=True)
class Row:
    """A diagnosis. Its texts are formats of the facts, `{f.name}`, and of what when() `{found}`."""

    when: Callable[[Any], Any]  # facts -> what is found; anything false: the row does not apply
    seen: str | Callable[[Any], Wrong | Note]  # in place of a text: what makes the whole diagnosis
    hint: str = ""
    where: str = ""
    sure: bool = False  # whatever else the machine had to do, it is no matter of time
    note: bool = False  # it is right, and worth a word


def find(rows: Iterable[Row], facts: object, expected: str = "") -> Wrong | Note | None:
    """Return what the first row that applies to the facts says, or None."""
    for row in rows:
        found = row.when(facts)
        if not found:
            continue
        if not isinstance(row.seen, str):
            return row.seen(facts)
        formats = (row.seen, row.where, row.hint)
        seen, where, hint = (text.format(f=facts, found=found) for text in formats)
        return Note(seen, where, hint) if row.note else Wrong(expected, seen, where, hint, row.sure)
    return None


def demand(rows: Iterable[Row], facts: object, expected: str) -> Note | None:
    """Return the Note of the first row that applies, or None. Raises its Wrong."""
    expected = expected.format(f=facts)
    found = find(rows, facts, expected)
    if isinstance(found, Wrong):
        found.expected = found.expected or expected
        raise found
    return found
