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
    assert output.count("\nok ") + output.startswith("ok ") == 6, output


def test_a_self_test_finds_a_check_that_passes_everything(tmp_path):
    course = shutil.copytree(SQUARE, tmp_path / "square")
    shutil.rmtree(course / "solutions/right_clockwise")
    shutil.rmtree(course / "solutions/right_with_odometry")
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


# A second course, written from COURSES.md alone: what comes on /ask is answered on /answer, in
# capitals, and a Twist on /cmd_vel is mirrored on /mirrored.
SHOUT_YAML = """
title: Answers
exercises: {"1": shout, "2": {title: mirror, document: page, solution: [solutions/right/shout]}}
"""
SHOUT_CHECKS = """
from tutorial_check.course import check
from tutorial_check.model import Note, Wrong
from tutorial_check.scripts import crash, program_of

@check("A1", "it answers in capitals", "1.2", look="rostopic echo /answer")
def shouts(session):
    script = program_of(session, "shout", "shout.py")
    with session.stage() as stage:
        stage.call("advertise", "/ask", "String")
        stage.call("listen", "/answer", "String")
        program = stage.start("shout", script)
        if not stage.meet(program, "/ask", "/answer"):
            raise crash(session, "shout", program, "it waits for questions", "rospy.spin()")
        stage.call("send", "/ask", "who is there")
        stage.wait(lambda: stage.call("count", "/answer"), 5.0)
        answers = [value for _, _, value in stage.call("heard", "/answer")]
    if answers != ["WHO IS THERE"]:
        raise Wrong("WHO IS THERE", f"{answers}", script, "str.upper()")

@check("A2", "it mirrors", "2", "A1")
def mirrors(session):
    with session.stage() as stage:
        stage.call("advertise", "/cmd_vel", "Twist")
        stage.call("listen", "/mirrored", "Twist")
        program = stage.start("shout", program_of(session, "shout", "shout.py"))
        stage.meet(program, "/cmd_vel", "/mirrored")
        stage.call("send", "/cmd_vel", (1.0, 0, 0, 0, 0, 0.5))
        stage.wait(lambda: stage.call("count", "/mirrored"), 5.0)
        heard = [value for _, _, value in stage.call("heard", "/mirrored")]
    if heard != [(-1.0, 0, 0, 0, 0, -0.5)]:
        raise Wrong("-1 m/s and -0.5 rad/s for 1 and 0.5", f"{heard}")
    return Note("as asked")
"""
SHOUT = """#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import String

def answer(question):
    answers.publish(question.data.upper())

def mirror(twist):
    twist.linear.x, twist.angular.z = -twist.linear.x, -twist.angular.z
    mirrored.publish(twist)

rospy.init_node("shout")
answers = rospy.Publisher("answer", String, queue_size=1)
mirrored = rospy.Publisher("mirrored", Twist, queue_size=1)
rospy.Subscriber("ask", String, answer)
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
    course = tmp_path / "answers"
    for name, text in (
        ("right", SHOUT),
        ("right_late", SHOUT.replace("import rospy\n", f"import rospy\n{LATE}", 1)),
        ("wrong_A1_as_it_came", SHOUT.replace(".upper()", "")),
        ("wrong_A1_ends", SHOUT.replace("rospy.spin()", "")),
        ("wrong_A2_half", SHOUT.replace(", -twist.angular.z", ", twist.angular.z")),
    ):
        package = course / "solutions" / name / "shout"
        (package / "scripts").mkdir(parents=True)
        (package / "scripts/shout.py").write_text(text)
        (package / "scripts/shout.py").chmod(0o755)
    for name in ("package.xml", "CMakeLists.txt"):
        text = (SQUARE / "solutions/right/square" / name).read_text().replace("square", "shout")
        for right in (course / "solutions").glob("right*"):
            (right / "shout" / name).write_text(text)
    (course / "course.yaml").write_text(SHOUT_YAML)
    (course / "answers.py").write_text(SHOUT_CHECKS)
    code, output = check("--course", course, "--self-test")
    assert code == 0, output
    assert "ok     wrong_A2_half: [(-1.0, 0.0, 0.0, 0.0, 0.0, 0.5)]" in output, output
    code, output = check(
        "--course", course, "--all", course / "solutions", "--out", tmp_path / "out"
    )
    assert code == 1, output  # those that are wrong have no package.xml
    assert "right: 2 of 2 exercises done" in output, output
    assert "<small>mirror</small>" in (tmp_path / "out/table.html").read_text()
