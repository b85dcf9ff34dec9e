"""Texts from files and programs, made safe for a terminal."""

from __future__ import annotations

import re

# Escape sequences of a terminal (ECMA-48: CSI, and strings up to BEL or ST), then all
# other control characters except tab and line feed. XML forbids the same ones, and lone surrogates.
_ESCAPES = re.compile(
    r"\x1b\[[0-?]*[ -/]*[@-~]|\x1b[\]P^_X][^\x07\x1b]*(?:\x07|\x1b\\)?"
    r"|[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]"
)
LONGEST = 600  # characters


def quotable(text: str) -> str:
    """Return a printable text of at most LONGEST characters, for use in a sentence."""
    text = printable(text)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."


def printable(text: str) -> str:
    """Return a text without the characters that control a terminal."""
    return _ESCAPES.sub("", text)
