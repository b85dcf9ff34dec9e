"""Command lines of this suite's programs."""

from __future__ import annotations

import argparse
import math
import re
from typing import NoReturn

from node_kit.printable import printable

CHOICE = re.compile(r"argument \S+: invalid choice: '(.*)' \(choose from (.*)\)")


class Parser(argparse.ArgumentParser):
    """Report a mistake in one line, with exit code 2."""

    def error(self, message: str) -> NoReturn:
        """Print the line and exit."""
        wrong = CHOICE.fullmatch(message)
        if wrong:
            *others, last = wrong[2].replace("'", "").split(", ")
            message = f'"{wrong[1]}": must be {", ".join(others)} or {last}'
        self.exit(2, printable(f"{self.prog}: {message}; {self.prog} --help shows more\n"))


def above_zero(text: str) -> float:
    """Return a finite number above 0, such as a time. Raises argparse.ArgumentTypeError."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"{text}: not a number above 0, such as 0.5 or 20")
    return number
