"""Collect the figures of benchmarks, and print them as the tables of the READMEs."""

import os
import platform
from collections import defaultdict

import pytest

_rows = defaultdict(list)  # package -> rows
_load = os.getloadavg()[0]  # at the start: other work on the machine distorts the figures


@pytest.fixture
def figure(request):
    """A function that adds a row (what, measured, demanded) to the table of the test's package."""
    return lambda *row: _rows[request.path.parents[1].name].append(row)


def pytest_terminal_summary(terminalreporter):
    for package, rows in _rows.items():
        terminalreporter.section(f"figures of {package}")
        terminalreporter.line(
            f"Python {platform.python_version()}, {os.cpu_count()} processors,"
            f" load at the beginning {_load:.1f}"
        )
        terminalreporter.line("| figure | measured | demanded |")
        terminalreporter.line("|---|---|---|")
        for row in rows:
            terminalreporter.line("| " + " | ".join(row) + " |")
