"""A course of one's own: the worked example of COURSES.md, as the page says."""

import shutil
import subprocess
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
SQUARE = REPOSITORY / "common/doc/square"


def check(*words):
    """Return (exit code, output) of ./tutorial check."""
    command = [REPOSITORY / "tutorial", "check", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600)
    return done.returncode, done.stdout + done.stderr


def test_the_squares_solutions_come_to_what_they_should():
    code, output = check("--course", SQUARE, "--self-test")
    assert code == 0, output
    assert output.count("\nok ") + output.startswith("ok ") == 5, output


def test_a_self_test_finds_a_check_that_passes_everything(tmp_path):
    course = shutil.copytree(SQUARE, tmp_path / "square")
    shutil.rmtree(course / "solutions/right_clockwise")
    for name in ("wrong_S1_another_topic", "wrong_S3_drives_on"):
        shutil.rmtree(course / "solutions" / name)
    checks = (course / "square.py").read_text().replace("NEAR_M = 0.1", "NEAR_M = 10.0")
    (course / "square.py").write_text(checks)
    code, output = check("--course", course, "--self-test")
    assert code == 1, output
    assert "FAILED wrong_S2_turns_too_little: S2 should be wrong, and nothing is" in output


def test_a_student_of_a_course_reads_its_words(tmp_path):
    src = tmp_path / "ws" / "src"
    shutil.copytree(SQUARE / "solutions/right", src)
    script = src / "square/scripts/square.py"
    script.write_text(script.read_text().replace("rospy.init_node", "rospy.initnode"))
    code, output = check("--course", SQUARE, "--in", tmp_path / "ws")
    assert code == 1
    assert "1 a square of 1 m\n  WRONG  S1  it drives" in output, output
    assert "where:    scripts/square.py:" in output and "task sheet 1" in output
    code, output = check("--course", SQUARE, "--in", tmp_path / "ws", "4.3")
    assert (code, "no exercise 4.3; there are 1" in output) == (2, True), output


# A second course, written from COURSES.md alone: a Twist on /cmd_vel is mirrored on /mirrored.
MIRROR_YAML = """
title: Answers
exercises: {"1": {title: mirror, document: page, solution: [solutions/right/mirror]}}
"""
MIRROR_CHECKS = """
from tutorial_check.course import check
from tutorial_check.model import Note, Wrong
from tutorial_check.scripts import crash, program_of

@check("A1", "it mirrors", "1.2", look="rostopic echo /mirrored")
def mirrors(session):
    script = program_of(session, "mirror", "mirror.py")
    with session.stage() as stage:
        stage.call("advertise", "/cmd_vel", "Twist")
        stage.call("listen", "/mirrored", "Twist")
        program = stage.start("mirror", script)
        if not stage.meet(program, "/cmd_vel", "/mirrored"):
            raise crash(session, "mirror", program, "it waits for Twists", "rospy.spin()")
        stage.call("send", "/cmd_vel", (1.0, 0, 0, 0, 0, 0.5))
        stage.wait(lambda: stage.call("count", "/mirrored"), 5.0)
        heard = [value for _, _, value in stage.call("heard", "/mirrored")]
    if heard != [(-1.0, 0, 0, 0, 0, -0.5)]:
        raise Wrong("-1 m/s and -0.5 rad/s for 1 and 0.5", f"{heard}", script)
    return Note("as asked")
"""
MIRROR = """#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist

def mirror(twist):
    twist.linear.x, twist.angular.z = -twist.linear.x, -twist.angular.z
    mirrored.publish(twist)

rospy.init_node("mirror")
mirrored = rospy.Publisher("mirrored", Twist, queue_size=1)
rospy.Subscriber("cmd_vel", Twist, mirror)
rospy.spin()
"""
# What a busy machine may do: rospy is connected long before it attaches the callback.
LATE = """
import time
from rospy.topics import _SubscriberImpl
attach = _SubscriberImpl.add_callback

def attach_late(*arguments):
    until_s = time.monotonic() + 0.2
    while time.monotonic() < until_s:
        pass
    attach(*arguments)

_SubscriberImpl.add_callback = attach_late
"""


def test_a_second_course_from_the_page_alone(tmp_path):
    course = tmp_path / "mirrors"
    for name, text in (
        ("right", MIRROR),
        ("right_late", MIRROR.replace("import rospy\n", f"import rospy\n{LATE}", 1)),
        ("wrong_A1_ends", MIRROR.replace("rospy.spin()", "")),
        ("wrong_A1_half", MIRROR.replace(", -twist.angular.z", ", twist.angular.z")),
    ):
        script = course / "solutions" / name / "mirror/scripts/mirror.py"
        script.parent.mkdir(parents=True)
        script.write_text(text)
        script.chmod(0o755)
    for name in ("package.xml", "CMakeLists.txt"):
        text = (SQUARE / "solutions/right/square" / name).read_text().replace("square", "mirror")
        for right in (course / "solutions").glob("right*"):
            (right / "mirror" / name).write_text(text)
    (course / "course.yaml").write_text(MIRROR_YAML)
    (course / "mirrors.py").write_text(MIRROR_CHECKS)
    code, output = check("--course", course, "--self-test")
    assert code == 0, output
    assert "ok     wrong_A1_half: [(-1.0, 0.0, 0.0, 0.0, 0.0, 0.5)]" in output, output
    out = tmp_path / "out"
    code, output = check("--course", course, "--all", course / "solutions", "--out", out)
    assert code == 1, output  # those that are wrong have no package.xml
    assert "right: 1 of 1 exercises done" in output, output
    assert "<small>mirror</small>" in (out / "table.html").read_text()
