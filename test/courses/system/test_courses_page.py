"""The first course of COURSES.md, copied from the page, judges a right and a wrong program."""

import re
import subprocess

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

pytestmark = claim("The course that COURSES.md begins with judges a right and a wrong program")
PAGE = (REPOSITORY / "common/doc/COURSES.md").read_text()
MANIFEST = """<package format="2"><name>hello</name><version>0.0.0</version>
<description>x</description><maintainer email="s@u.example">s</maintainer><license>x</license>
<buildtool_depend>catkin</buildtool_depend><depend>rospy</depend></package>"""
PROGRAM = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String
rospy.init_node("greeter")
name = rospy.get_param("~name", "nobody")
pub = rospy.Publisher("/greeting", String, queue_size=1, latch=True)
pub.publish("hello " + name)
rospy.spin()
"""


@pytest.fixture
def report(tmp_path):
    """report(text of greeter.py): check it with the page's two files; (exit code, report)."""

    def check(program):
        for language, name in (("yaml", "course.yaml"), ("python", "greetings.py")):
            text = re.search(rf"^```{language}\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)[1]
            (tmp_path / "course").mkdir(exist_ok=True)
            (tmp_path / "course" / name).write_text(text)
        script = tmp_path / "ws/src/hello/scripts/greeter.py"
        script.parent.mkdir(parents=True)
        script.write_text(program)
        script.chmod(0o755)
        (script.parents[1] / "package.xml").write_text(MANIFEST)
        words = ["check", "--course", tmp_path / "course", "--in", tmp_path / "ws"]
        done = subprocess.run(
            [REPOSITORY / "tutorial", *words], capture_output=True, text=True, check=False
        )
        return done.returncode, done.stdout + done.stderr

    return check


def test_a_right_program_passes(report):
    code, text = report(PROGRAM)
    assert code == 0 and "ok     G1  it greets by the name in ~name" in text, text


@pytest.mark.parametrize(("changed", "words"), [
    (PROGRAM.replace("+ name", "+ 'you'"), ("hello you", "greeter.py:5", "~name")),
    (PROGRAM.replace("rospy.spin", "rospy.spni"), ("greeter.py:8", "has no attribute 'spni'")),
])  # fmt: skip
def test_a_wrong_one_has_its_line(report, changed, words):
    code, text = report(changed)
    assert code == 1 and all(word in text for word in words), text
