"""What the tests of the checker share: right workspaces to change, and the table at the end."""

import os
import shutil
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]
BAG = REPOSITORY / "joy2twist" / "bag" / "joy.bag"
KINDS = ("found", "wrongly blamed", "missed", "not checked")


def pytest_addoption(parser):
    """The rows are many, and each builds a workspace."""
    parser.addoption("--every", type=int, default=1, metavar="N", help="only every Nth row of data")


def pytest_collection_modifyitems(config, items):
    """Leave out the other rows."""
    rows = [
        item for item in items if "row" in getattr(getattr(item, "callspec", None), "params", ())
    ]
    left_out = {item for at, item in enumerate(rows) if at % config.getoption("--every")}
    items[:] = [item for item in items if item not in left_out]


@pytest.fixture(scope="session")
def floor():
    """setup.bash of what the exercises stand on."""
    return os.environ["TUTORIAL_FLOOR"]


@pytest.fixture
def literal(tmp_path):
    """A workspace with a literal solution of the handout; its src."""
    src = tmp_path / "ws" / "src"
    shutil.copytree(HERE / "literal", src)
    (src / "joy2twist" / "bag").mkdir()
    shutil.copy(BAG, src / "joy2twist" / "bag")
    return src


@pytest.fixture
def solutions(tmp_path):
    """A workspace with the solutions of this suite; its src."""
    src = tmp_path / "ws" / "src"
    for name in ("beginner_tutorials", "joy2twist"):
        shutil.copytree(REPOSITORY / name, src / name)
    return src


def pytest_terminal_summary(terminalreporter):
    """The table of mistakes: found, wrongly blamed, missed."""
    table = {kind: [] for kind in KINDS}
    alarms, checks = [], 0
    for reports in terminalreporter.stats.values():
        for report in reports:
            for name, value in (
                getattr(report, "user_properties", ())
                if getattr(report, "when", "") == "call"
                else ()
            ):
                if name in table:
                    table[name].append(value)
                elif name == "checks":
                    checks += value
                elif name == "alarm":
                    alarms.append(value)
    if any(table.values()):
        terminalreporter.section("mistakes")
        for kind, rows in table.items():
            terminalreporter.write_line(f"{kind:>15}: {len(rows)}")
            if kind != "found":
                for row in rows:
                    terminalreporter.write_line(f"{'':>17}{row}")
    if checks:
        terminalreporter.section("right solutions")
        terminalreporter.write_line(f"{checks} checks, {len(alarms)} false alarms")
        for alarm in alarms:
            terminalreporter.write_line(f"  {alarm}")
