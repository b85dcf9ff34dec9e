"""Types for the command lines of this suite's programs (pure)."""

import argparse
import math


def above_zero(text: str) -> float:
    """Return a finite number above 0, such as a time. Raises what argparse reports."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"{text}: not a number above 0, such as 0.5 or 20")
    return number
