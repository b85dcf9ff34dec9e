"""What the tests of the checker share: right workspaces to change."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import stored

from tutorial_check.launcher import examine

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]
BAG = REPOSITORY / "joy2twist" / "bag" / "joy.bag"
OPTIONS = {
    "--every": (1, "only every Nth row of data"),
    "--first": (0, "the row with which --every begins"),
    "--students": (4, "how many in the test of --all"),
    "--submissions": (8, "how many on a cluster"),
    "--everything": (False, "all exercises, and not only those of the mistakes; an hour"),
    "--store": (False, "store what the programs of the rows did, for the unit tests"),
    "--busy": (False, "beside an endless loop on each processor"),
}


def pytest_addoption(parser):
    """The rows are many, and each builds a workspace."""
    for name, (default, what) in OPTIONS.items():
        kind = {"action": "store_true"} if default is False else {"type": int, "metavar": "N"}
        parser.addoption(name, default=default, help=what, **kind)


def pytest_configure(config):
    """Keep the processors busy, if asked to; once, and not in each worker."""
    is_worker = hasattr(config, "workerinput")
    count = os.cpu_count() if config.getoption("--busy") and not is_worker else 0
    loop = [sys.executable, "-c", "while True: pass"]
    config.loops = [subprocess.Popen(loop) for _ in range(count)]


def pytest_unconfigure(config):
    """Leave them in peace."""
    for process in config.loops:
        process.kill()
        process.wait()


def pytest_collection_modifyitems(config, items):
    """Leave out what was not asked for."""
    option = config.getoption
    if not option("--everything"):
        items[:] = [item for item in items if "in_all_exercises" not in item.name]
    rows = [item for item in items if "row" in getattr(item, "fixturenames", ())]
    left_out = {item for at, item in enumerate(rows, -option("--first")) if at % option("--every")}
    items[:] = [item for item in items if item not in left_out]


@pytest.fixture(scope="session")
def underlay():
    """setup.bash of the underlay."""
    return os.environ["TUTORIAL_UNDERLAY"]


@pytest.fixture
def examined(request, underlay, tmp_path):
    """examined(workspace, exercises, ...): the Outcomes, recorded again; what is stored says the same."""

    def recorded(workspace, exercises, **about):
        outcomes = examine(workspace, underlay, exercises, **about)
        name = request.node.name
        if request.config.getoption("--store"):
            stored.write(name, outcomes, workspace, underlay)
        folder = tmp_path / "judged"
        folder.mkdir()
        again = stored.judged(name, workspace, underlay, exercises, folder, **about)
        assert statuses(again) == statuses(outcomes), "stored recordings are judged otherwise"
        return outcomes

    return recorded


def statuses(outcomes):
    """{check: what it came to}."""
    return {found.id: found.status for outcome in outcomes for found in outcome.results}


@pytest.fixture
def literal(tmp_path):
    """A workspace with a literal solution of the handout; its src."""
    src = tmp_path / "ws" / "src"
    shutil.copytree(HERE / "literal", src)
    (src / "joy2twist" / "bag").mkdir()
    shutil.copy(BAG, src / "joy2twist" / "bag")
    return src
