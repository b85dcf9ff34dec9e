"""Edits that change a right solution, from which the rows are made; they touch only files."""

import shutil
from pathlib import Path
from typing import Callable

import pytest
import rosbag
from solution import J
from std_msgs.msg import String

Edit = Callable[[Path], object]  # changes a src folder
HERE = Path(__file__).resolve().parent


@pytest.fixture
def literal(tmp_path):
    """The src folder of a workspace with a literal solution of the handout."""
    return _workspace(HERE / "literal", tmp_path)


@pytest.fixture
def literal_cpp(tmp_path):
    """The same in C++."""
    return _workspace(HERE / "literal_cpp", tmp_path)


def _workspace(solution, folder):
    src = shutil.copytree(solution, folder / "ws" / "src")
    shutil.copytree(HERE.parents[2] / J / "bag", src / J / "bag")
    return src


def put(path, old, new, count=-1, same="&"):
    """Replace a text in a file. same: what in new stands for old."""

    def edit(src):
        file = src / path
        text = file.read_bytes().decode()
        assert old in text, f"{old!r} is not in {path}"
        file.write_bytes(text.replace(old, new.replace(same, old), count).encode())

    return edit


def put_cpp(path, old, new, count=-1):
    """Replace a text in a file of C++; @ in new stands for old."""
    return put(path, old, new, count, same="@")


def made(path):
    """Return a path after making its folder if necessary."""
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def write(path, text, mode=0o755):
    def edit(src):
        made(src / path).write_text(text)
        (src / path).chmod(mode)

    return edit


def move(old, new):
    """Rename or move; new may leave src."""
    return lambda src: (src / old).rename(made(src / new))


def copy(old, new):
    return lambda src: shutil.copy(src / old, made(src / new))


def remove(path):
    return lambda src: (src / path).unlink()


def chmod(path, mode):
    return lambda src: (src / path).chmod(mode)


def windows(path):
    return lambda src: (src / path).write_bytes((src / path).read_bytes().replace(b"\n", b"\r\n"))


def latin1(path, after, text):
    """Add a line of text in Latin-1 after an existing line."""

    def edit(src):
        put(path, after, f"{after}{text}\n", 1)(src)
        file = src / path
        file.write_bytes(file.read_text().encode("latin-1"))

    return edit


def lines(path, *numbers):
    """Remove the lines with these numbers, counted from 1."""

    def edit(src):
        text = (src / path).read_text().splitlines(keepends=True)
        (src / path).write_text("".join(line for n, line in enumerate(text, 1) if n not in numbers))

    return edit


def chatter(path):
    """Make a recording of another topic."""

    def edit(src):
        with rosbag.Bag(str(made(src / path)), "w") as bag:
            bag.write("/chatter", String("x"))

    return edit


def built(below, home="", **files):
    """Make as much of a build's devel folder over these folders as is read, and these files."""

    def edit(src):
        texts = {
            "_setup_util.py": f"    CMAKE_PREFIX_PATH = r'{below}'.split(';')\n",
            "setup.sh": f": ${{_CATKIN_SETUP_DIR:={home or src.parent}/devel}}\n",
            "setup.bash": "# as catkin has it\n",
        }
        for name, text in {**texts, **files}.items():
            made(src.parent / "devel" / name).write_text(text)

    return edit


def apply(edits, src):
    for edit in edits:
        edit(Path(src))


def at_night(*cases):
    """Mark cases that take too long for each commit for the nightly workflow."""
    return [pytest.param(case, marks=pytest.mark.night) for case in cases]
