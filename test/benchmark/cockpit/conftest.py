"""Collects the figures of a run and prints them as the table of the package's README."""

import os
import platform

import pytest

_rows = []
_load = os.getloadavg()[0]  # when the run begins: other work on the machine spoils the figures


@pytest.fixture
def figure():
    """Take (what, measured, demanded) for the table."""
    return lambda *row: _rows.append(row)


def pytest_terminal_summary(terminalreporter):
    if _rows:
        terminalreporter.section("figures of cockpit")
        terminalreporter.line(
            f"Python {platform.python_version()}, {os.cpu_count()} processors,"
            f" load at the beginning {_load:.1f}"
        )
        terminalreporter.line("| figure | measured | demanded |")
        terminalreporter.line("|---|---|---|")
        for row in _rows:
            terminalreporter.line("| " + " | ".join(row) + " |")
