"""Texts from files and programs, as a terminal may show them (pure)."""

from __future__ import annotations

import re

# Escape sequences of a terminal (ECMA-48: CSI, and strings up to BEL or ST), then what is left of
# the control characters but tab and line feed. XML forbids the same ones, and lone surrogates.
_ESCAPES = re.compile(
    r"\x1b\[[0-?]*[ -/]*[@-~]|\x1b[\]P^_X][^\x07\x1b]*(?:\x07|\x1b\\)?"
    r"|[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]"
)
LONGEST = 600  # characters


def quotable(text: str) -> str:
    """Return a printable text of at most LONGEST characters, to be quoted in a sentence."""
    text = printable(text)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."


def printable(text: str) -> str:
    """Return a text without what would move the cursor, or colour, rename or clear a terminal."""
    return _ESCAPES.sub("", text)
