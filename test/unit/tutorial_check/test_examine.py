"""The examination by itself, in a process of its own as it always is."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tutorial_check.examine import in_the_students_words
from tutorial_check.model import Result
from tutorial_check.workspace import Layout

MAKE_A_FOLDER = """
import os
from tutorial_check import examine

def make_a_folder(orders, tell, told):
    os.makedirs(orders["folder"] + "/made")
    tell(mode=os.stat(orders["folder"] + "/made").st_mode & 0o777)

examine.examine = make_a_folder
examine.main()
"""


def test_others_may_read_what_it_writes_whatever_the_users_umask(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", MAKE_A_FOLDER],
        input=json.dumps({"apart": False, "folder": str(tmp_path / "scratch")}),
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: os.umask(0o077),
    )
    assert json.loads(done.stdout.splitlines()[0]) == {"mode": 0o755}, done.stderr
    assert not (tmp_path / "scratch").exists()


@pytest.mark.parametrize(
    ("own", "root", "is_workspace", "told"),
    [
        (True, "/home/ann/my ws", True, "chmod +x '/home/ann/my ws'/src/a.py"),
        (True, "/home/ann/packages", False, "chmod +x /home/ann/packages/a.py"),
        (False, "/home/ann/ws", True, "chmod +x src/a.py"),  # of --all: the folder is no matter
        (True, "/tmp/check/unpacked", True, "chmod +x src/a.py"),  # of a zip
    ],
)
def test_commands_name_whole_paths_of_the_callers_own_workspace(own, root, is_workspace, told):
    copy = "/tmp/check/ws/src/a.py"
    result = Result("C5", "wrong", "t", where=copy, hint=f"chmod +x {copy}", look=f"ls -l {copy}")
    layout = Layout(Path(root), Path(root), is_workspace)
    words = in_the_students_words(Path("/tmp/check"), layout, own, result)
    assert words["hint"] == told
    assert words["look"] == told.replace("chmod +x", "ls -l")
    assert words["where"] == ("src/a.py" if is_workspace else "a.py")
