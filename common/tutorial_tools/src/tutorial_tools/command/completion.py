"""Completion of ./tutorial for bash, from the parsers of its words."""

from __future__ import annotations

import argparse
from collections.abc import Mapping

# The name is that of the command line: ./tutorial from a clone, tutorial in its shell.
SCRIPT = """\
_tutorial() {
    local IFS=$'\\n'
    COMPREPLY=($("${COMP_WORDS[0]}" completion "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
}
complete -o default -F _tutorial tutorial ./tutorial"""
OPTIONS = {"check": ("--in", "--all", "--watch", "--no-hints"), "cockpit": ("--port", "--lan")}


def candidates(
    words: Mapping[str, argparse.ArgumentParser], kinds: dict[str, str], typed: list[str]
) -> list[str]:
    """Return what the last typed word may become; nothing leaves it to bash, as for files."""
    *before, last = typed
    if not before:
        found = list(words)
    else:
        parser = words.get(before[0])
        actions = parser._actions if parser else []  # noqa: SLF001 (argparse offers no other way)
        found = [option for action in actions for option in action.option_strings]
        found += OPTIONS.get(before[0], ())
        if len(before) == 1:
            found += kinds if before[0] == "test" else []
            found += ["system", "workspace"] if before[0] == "setup" else []
    return [each for each in found if each.startswith(last) and (last or each[0] != "-")]
