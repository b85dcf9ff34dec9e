"""What the tests of the checker share: right workspaces to change."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import variants

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]
BAG = REPOSITORY / "joy2twist" / "bag" / "joy.bag"
OPTIONS = {
    "--every": (1, "only every Nth row of data"),
    "--first": (0, "the row with which --every begins"),
    "--students": (4, "how many in the test of --all"),
    "--submissions": (8, "how many on a cluster"),
    "--repeat": (0, "only N checks of right solutions, in turn"),
    "--everything": (False, "all exercises, and not only those of the mistakes; an hour"),
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


def pytest_generate_tests(metafunc):
    """The rows of right solutions: each once, or as many in turn as are asked for."""
    if "variant" in metafunc.fixturenames:
        count = metafunc.config.getoption("--repeat") or len(variants.ROWS)
        rows = [variants.ROWS[turn % len(variants.ROWS)] for turn in range(count)]
        names = [f"{turn} {row[0]}" for turn, row in enumerate(rows)]
        metafunc.parametrize("variant", rows, ids=names)


def is_row(item):
    return bool({"row", "variant"} & set(getattr(item, "fixturenames", ())))


def pytest_collection_modifyitems(config, items):
    """Leave out what was not asked for."""
    option = config.getoption
    if option("--repeat"):
        items[:] = [item for item in items if "variant" in getattr(item, "fixturenames", ())]
    if not option("--everything"):
        items[:] = [item for item in items if "in_all_exercises" not in item.name]
    rows = list(filter(is_row, items))
    left_out = {item for at, item in enumerate(rows, -option("--first")) if at % option("--every")}
    items[:] = [item for item in items if item not in left_out]


@pytest.fixture(scope="session")
def underlay():
    """setup.bash of the underlay."""
    return os.environ["TUTORIAL_UNDERLAY"]


@pytest.fixture
def literal(tmp_path):
    """A workspace with a literal solution of the handout; its src."""
    src = tmp_path / "ws" / "src"
    shutil.copytree(HERE / "literal", src)
    (src / "joy2twist" / "bag").mkdir()
    shutil.copy(BAG, src / "joy2twist" / "bag")
    return src
