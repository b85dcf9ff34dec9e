"""What is hidden, and what is not: in namespaces, which the system has to grant."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from tutorial_check import place

pytestmark = pytest.mark.skipif(not place.wrapper(), reason="no namespaces here: nothing is hidden")
FURNISH = """
import os, subprocess, sys
from pathlib import Path
from tutorial_check import place

home, scratch = map(Path, sys.argv[1:3])
{before}
with place.removed(scratch, True):
    limited = place.limit(scratch)
    print(limited, place.furnish(scratch, str(home), [str(home / "link"), home / "bags/joy.bag"]))
    (scratch / "written").touch()
    for path in ("secret", "bags/secret", "bags/joy.bag", "link/file", "course/ws/file"):
        print(path, (home / path).exists())
    for path in ("bags/joy.bag", "course/ws/file"):
        try:
            (home / path).write_text("changed")
            print("written")
        except OSError:
            print("read-only")
"""


@pytest.fixture(params=["/tmp", "/var/tmp"])  # the one is hidden as well
def home(request):
    """A home folder with a workspace, a link to it, and a file that is nobody's business."""
    with tempfile.TemporaryDirectory(dir=request.param) as folder:
        home = Path(folder) / "home"
        (home / "course" / "ws").mkdir(parents=True)
        (home / "course" / "ws" / "file").touch()
        (home / "bags").mkdir()
        for path in ("secret", "bags/secret", "bags/joy.bag"):
            (home / path).touch()
        (home / "link").symlink_to(home / "course" / "ws")
        yield home


def run(text, *words):
    """The lines that a Python program prints in a place of its own."""
    done = subprocess.run(
        [*place.wrapper(), sys.executable, "-c", text, *words],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def furnish(home, scratch, before=""):
    """What is seen in a furnished place: each line is a fact."""
    scratch.mkdir(parents=True)
    return run(FURNISH.format(before=before), home, scratch)


HIDDEN = [
    "True True",
    "secret False",
    "bags/secret False",
    "bags/joy.bag True",
    "link/file True",
    "course/ws/file True",
    "read-only",
    "read-only",
]


@pytest.mark.parametrize("folder", ["scratch", "home/tmp/scratch", "home/course/ws/tmp/scratch"])
def test_home_is_hidden_but_for_what_is_needed(home, folder):
    assert furnish(home, home.parent / folder) == HIDDEN


OPENED = """
import os, sys
from pathlib import Path
from tutorial_check import place

home, scratch, suite = map(Path, sys.argv[1:])
scratch.mkdir()
assert place.limit(scratch) and place.furnish(scratch, str(home), [suite])
print((suite / "file").exists(), (suite.parent / "secret").exists())
os.setuid(2_000_000)
print((suite / "file").exists())
"""


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can run programs as another user")
def test_what_is_needed_from_another_ones_home_can_be_reached():
    with tempfile.TemporaryDirectory(dir="/var/tmp") as folder:
        home, prof = Path(folder) / "home", Path(folder) / "prof"
        home.mkdir()
        prof.mkdir(0o700)
        (prof / "suite").mkdir()
        (prof / "suite" / "file").touch()
        (prof / "secret").touch()
        assert run(OPENED, home, home / "scratch", prof / "suite") == ["True False", "True"]


@pytest.mark.parametrize("folder", ["scratch", "home/tmp/scratch"])
def test_at_the_end_the_folder_is_removed_and_no_other(home, folder):
    furnish(home, home.parent / folder)
    assert not (home.parent / folder).exists()
    assert (home / "course" / "ws" / "file").exists()


REFUSED = """
def mount(*words, mount=place._mount):
    if {words!r} <= set(map(str, words)):
        raise subprocess.SubprocessError("refused")
    mount(*words)


place._mount = mount
"""


@pytest.mark.parametrize("words", [{"remount,bind,ro"}, {"--rbind"}, {"size=64m,mode=1777"}])
def test_where_something_is_refused_nothing_is_hidden(home, words):
    seen = furnish(home, home.parent / "scratch", REFUSED.format(words=words))
    assert seen[:2] == ["True False", "secret True"]
    assert "False" not in "".join(seen[1:6])


NO_LIMIT = """
import socket
from tutorial_check import examine, place

def speak(*_):
    with socket.create_server(("127.0.0.1", 0)) as server:
        socket.create_connection(server.getsockname()).close()
    print("heard")
    raise SystemExit

place.limit = lambda scratch: False
examine._hand_in = speak
examine.examine({"folder": "/nowhere", "apart": True, "workspace": "/nowhere"}, None, None)
"""


def test_programs_hear_each_other_also_where_nothing_is_hidden():
    assert run(NO_LIMIT) == ["heard"]
