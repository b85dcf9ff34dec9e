"""Collects the figures of a run and prints them as the table of the package's README."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # for live.py: pytest imports by file, not by folder
_rows = []


@pytest.fixture
def figure():
    """Take (what, measured, demanded) for the table."""
    return lambda *row: _rows.append(row)


def pytest_terminal_summary(terminalreporter):
    if _rows:
        terminalreporter.section("figures of fake_turtlebot_sim")
        terminalreporter.line("| figure | measured | demanded |")
        terminalreporter.line("|---|---|---|")
        for row in _rows:
            terminalreporter.line("| " + " | ".join(row) + " |")
