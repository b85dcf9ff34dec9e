"""How the examination names the files of the copy in which it works."""

from pathlib import Path

import pytest

from tutorial_check.examine import _paths_of_the_student as paths_of_the_student
from tutorial_check.model import Result
from tutorial_check.workspace import Layout


@pytest.mark.parametrize(
    ("own", "root", "is_workspace", "sent"),
    [
        (True, "/home/ann/my ws", True, "chmod +x '/home/ann/my ws'/src/a.py"),
        (True, "/home/ann/packages", False, "chmod +x /home/ann/packages/a.py"),
        (False, "/home/ann/ws", True, "chmod +x src/a.py"),  # of --all: the folder is no matter
        (True, "/tmp/check/unpacked", True, "chmod +x src/a.py"),  # of a zip
    ],
)
def test_commands_name_whole_paths_of_the_callers_own_workspace(own, root, is_workspace, sent):
    copy = "/tmp/check/ws/src/a.py"
    result = Result("C5", "wrong", "t", where=copy, hint=f"chmod +x {copy}", look=f"ls -l {copy}")
    layout = Layout(Path(root), Path(root), is_workspace)
    words = paths_of_the_student(Path("/tmp/check"), layout, own)(result)
    assert words["hint"] == sent
    assert words["look"] == sent.replace("chmod +x", "ls -l")
    assert words["where"] == ("src/a.py" if is_workspace else "a.py")
