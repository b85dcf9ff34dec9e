"""Cases of a table that are too long for each commit."""

import pytest


def at_night(*cases):
    """Return the cases as parameters of pytest.mark.parametrize that the nightly workflow runs."""
    return [pytest.param(case, marks=pytest.mark.night) for case in cases]
