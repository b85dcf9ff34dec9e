"""Options and fixtures of the exercises: right workspaces to change."""

import os
import shutil
import tempfile
from pathlib import Path

import kobuki_msgs
import pytest
import stored
from edits import literal, literal_cpp  # noqa: F401
from right_check import check  # noqa: F401

from tutorial_check.examining.examination import examine
from tutorial_check.submission.order import Order

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[2]
OPTIONS = {
    "--every": (1, "only every Nth row of data"),
    "--first": (0, "the row with which --every begins"),
    "--everything": (False, "all exercises, and not only those of the mistakes; an hour"),
    "--store": (False, "store what the programs of the rows did, for the unit tests"),
}


def pytest_addoption(parser):
    for name, (default, what) in OPTIONS.items():
        kind = {"action": "store_true"} if default is False else {"type": int, "metavar": "N"}
        parser.addoption(name, default=default, help=what, **kind)


def pytest_collection_modifyitems(config, items):
    option = config.getoption
    if not option("--everything"):
        items[:] = [item for item in items if "in_all_exercises" not in item.name]
    rows = [item for item in items if "row" in getattr(item, "fixturenames", ())]
    left_out = {item for at, item in enumerate(rows, -option("--first")) if at % option("--every")}
    items[:] = [item for item in items if item not in left_out]


def pytest_sessionfinish(session):
    if session.config.getoption("--store", False) and not hasattr(session.config, "workerinput"):
        stored.merge()


@pytest.fixture(scope="session")
def underlay():
    return os.environ["TUTORIAL_UNDERLAY"]


@pytest.fixture
def folder():
    """A folder that all users may enter."""
    with tempfile.TemporaryDirectory() as made:
        Path(made).chmod(0o755)
        yield Path(made)


@pytest.fixture
def bare_underlay(folder):
    """The part of the underlay that all users can read: enough to build, not to run nodes."""
    if not all(folder.stat().st_mode & 0o001 for folder in HERE.parents):
        pytest.skip(f"{REPOSITORY} is closed to other users")
    packages = [source.parent for source in REPOSITORY.glob("*/*/src")]
    packages += [REPOSITORY / "fake_turtlebot_sim"]
    messages = folder / "messages"  # a copy: the build may be closed to others
    shutil.copytree(Path(kobuki_msgs.__file__).parent, messages / "kobuki_msgs")
    paths = ":".join([*(str(package / "src") for package in packages), str(messages)])
    for name in ("devel", "src"):
        (folder / "underlay" / name).mkdir(parents=True)
    for package in packages:
        (folder / "underlay" / "src" / package.name).symlink_to(package)
    (folder / "underlay" / "devel" / ".catkin").write_text(str(folder / "underlay" / "src"))
    setup = folder / "underlay" / "devel" / "setup.bash"
    setup.write_text(f"export PATH=/usr/bin:/bin PYTHONPATH={paths}\n")
    return setup


@pytest.fixture
def examined(request, underlay, tmp_path):
    """examined(workspace, exercises, ...): the Outcomes, recorded; stored ones must agree."""

    def recorded(workspace, exercises, **about):
        outcomes = examine(Order(workspace, underlay, exercises, **about))
        name = request.node.name
        if request.config.getoption("--store"):
            stored.write(name, outcomes, workspace, underlay)
        folder = tmp_path / "judged"
        folder.mkdir()
        again = stored.judged(name, workspace, underlay, exercises, folder, **about)
        assert verdicts(again) == verdicts(outcomes), "stored recordings are judged otherwise"
        return outcomes

    return recorded


def verdicts(outcomes):
    # A note is right, too: on a busy machine it may be about a Joy too old to be displayed.
    results = [result for outcome in outcomes for result in outcome.results]
    return {result.id: result.status.replace("note", "ok") for result in results}
