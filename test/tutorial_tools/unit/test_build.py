"""A student's workspace built over a ROS in /opt/ros, without this suite."""

import os
import subprocess

import pytest

from tutorial_testing.claims import claim
from tutorial_tools.io.command import build
from tutorial_tools.io.command.environment import environment_of

NOETIC = "/opt/ros/noetic"
# Like catkin's: --extend adds a workspace to those already sourced.
SETUP = '[ "$1" = --extend ] || CHAIN=\nexport CHAIN="{name} $CHAIN"\n'


@pytest.fixture
def student(tmp_path, monkeypatch):
    """student(below): the suite's workspace, and one that was built over these folders."""
    monkeypatch.setattr(build, "PREFIX", NOETIC)
    monkeypatch.setattr(build, "hidden_stand_ins", lambda *_: [])
    for name in ("suite", "suite/lower", "mine"):
        (tmp_path / name / "devel").mkdir(parents=True)
        (tmp_path / name / "devel/setup.bash").write_text(SETUP.format(name=name))
    (tmp_path / "mine/src").mkdir()

    def made(below):
        text = f"CMAKE_PREFIX_PATH = r'{below}'.split(';')\n"
        (tmp_path / "mine/devel/_setup_util.py").write_text(text)
        return tmp_path / "suite", tmp_path / "mine"

    return made


@claim(
    "A student's workspace that was built over a ROS in /opt/ros is used as it is, with the suite"
)
@pytest.mark.parametrize(("below", "chain", "words"), [
    (NOETIC, "mine suite/lower", ""),
    ("/elsewhere/lower/devel;/opt/ros/noetic", "suite/lower", "over another copy of it in /els"),
    ("/home/me/devel", "suite/lower", "was built without this suite: in the shell"),
])  # fmt: skip
def test_it_is_used_as_it_is_and_the_suite_below_it(student, capsys, below, chain, words):
    suite, mine = student(below)
    build.build_student(suite, mine)
    said = capsys.readouterr().err
    assert words in said and bool(words) == bool(said)
    assert environment_of(suite, "run", str(mine))["CHAIN"].split() == chain.split()
    shell = environment_of(suite, "shell", str(mine))
    assert bool(shell["TUTORIAL_BESIDE"]) == (below == NOETIC)
    script = ". common/tutorial_tools/etc/shellrc 2>/dev/null; echo $CHAIN"
    assert run_in(shell, script).split() == chain.split()


def run_in(environment, script):
    variables = {**environment, "HOME": os.devnull}
    words = ["bash", "-c", script]
    return subprocess.check_output(words, cwd=build.REPOSITORY, env=variables, text=True)
