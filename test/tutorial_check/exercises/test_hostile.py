"""Programs that hang, fork, print endlessly or forge: an honest verdict, no harm to others."""

import os
import shutil
import tempfile
import textwrap
from concurrent.futures import ThreadPoolExecutor

import pytest
from edits import put, write
from solution import JOY2TWIST, TALKER

from tutorial_check.examining.examination import examine
from tutorial_check.report.text import lines_of
from tutorial_check.sandbox import bubblewrap
from tutorial_check.submission.order import Order
from tutorial_testing.claims import claim
from tutorial_testing.processes import command_line

FIRST = "#!/usr/bin/env python3\nimport os\n"
MASTER = "xmlrpc.client\nxmlrpc.client.ServerProxy(os.environ['ROS_MASTER_URI'])"
FORKS = "while True:\n    try:\n        os.fork()\n    except OSError:\n        pass\n"
# Each replaces talker.py; with words of its report.
TALKERS = {
    "a fork bomb": (FORKS, "again and again"),
    "kills all it may": ("os.kill(-1, 9)\n", "has ended it"),
    "prints without end": ("while True:\n    print('x' * 1000000)\n", ""),
    "fills the disk": ("file = open('x', 'wb')\nwhile file.write(b'x' * 10**6):\n    pass\n", ""),
    "ends the master": (f"import {MASTER}.shutdown('/me', 'no more')\n", "has ended it"),
}  # fmt: skip
# It works, but leaves links where the checker writes changed copies of it (C9).
PLANTS_LINKS = """
import os
here = os.path.dirname(os.path.abspath(__file__))
for number in range(1, 9):
    link = os.path.join(here, "checked_%d_talker.py" % number)
    if not os.path.lexists(link):
        os.symlink({aim!r}, link)
"""
AFTER_INIT = "    rospy.init_node('listener', anonymous=True)\n"
FORGED = '\n{"exercise": "4.3", "result": {"id": "C16", "status": "ok", "title": "x"}}\n'
# Correct Twists, but not for the Joys that arrive.
FORGES_TWISTS = """import itertools
loud = rospy.Publisher('/cmd_vel', Twist, queue_size=1)
loud2 = rospy.Publisher('/joy', Joy, queue_size=1)
msg = Twist()
msg.linear.x = 0.4
msg.angular.z = 0.3
while not rospy.is_shutdown():
    loud.publish(msg)
    loud2.publish(Joy(axes=[0.3, 0.4, 0, 0, 0, 0], buttons=[0] * 12))
    rospy.sleep(0.02)
"""
# Python would run this at the start of each program with this home folder.
PLANTS_PYTHON = """import os, sys
ours = os.path.join(os.environ['HOME'], '..', 'ours', '.local', 'lib')
ours = os.path.join(ours, 'python%d.%d' % sys.version_info[:2], 'site-packages')
try:
    os.makedirs(ours)
    with open(os.path.join(ours, 'usercustomize.py'), 'w') as file:
        file.write('import os; os._exit(9)')
except OSError:
    pass
"""
# Lines of joy2twist.py after init_node, checks that may be wrong, words of the first.
JOINED = {
    "ends the master": (f"import os, {MASTER}.shutdown('/me', 'no more')", "C14", "has ended it"),
    "kills its group": ("import os\nos.killpg(0, 9)", "C14", "signal 9"),
    "prints a verdict": (f"print({FORGED!r} * 50)\n__import__('os')._exit(0)", "C14", ""),
    "writes into the workspace": ("open('VICTIM', 'w')", "C14", "may write only in its home"),
    "forges what the checker receives": (FORGES_TWISTS, "C14 C15", "/joy"),
}


def first_wrong(outcome):
    """Return (id, report) of the first check that is wrong or was not made."""
    wrong = (result for result in outcome.results if result.status not in ("ok", "note"))
    return next(((result.id, "\n".join(lines_of(result))) for result in wrong), (None, ""))


def processes_like(word):
    return [pid for pid in filter(str.isdigit, os.listdir("/proc")) if word in command_line(pid)]


@pytest.fixture
def scratch(folder, monkeypatch):
    """The folder for a test's copies only, which the programs' users may enter."""
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


@claim(
    "Programs that fork, kill, fill, print without end, end the master or forge have an honest "
    "verdict, and harm none beside them"
)
@pytest.mark.parametrize("what", JOINED)
def test_a_hostile_joy2twist_has_a_verdict_and_harms_no_file(literal, underlay, what):
    victim = literal / "joy2twist" / "package.xml"
    before, (lines, checks, words) = victim.read_bytes(), JOINED[what]
    lines = textwrap.indent(lines.replace("VICTIM", str(victim)), "    ")
    put(JOY2TWIST, AFTER_INIT, f"{AFTER_INIT}{lines}\n")(literal)
    (outcome,) = examine(Order(literal.parent, underlay, ["4.3"]))
    assert victim.read_bytes() == before
    check, report = first_wrong(outcome)
    assert check in checks.split() and words in report, report


@claim("What a program leaves in the checker's home folder runs in no program of the checker's")
def test_what_a_program_leaves_in_our_home_folder_runs_in_no_program_of_ours(literal, underlay):
    """In 4.4 the simulated robot starts after the program."""
    lines = textwrap.indent(PLANTS_PYTHON, "    ")
    put(JOY2TWIST, AFTER_INIT, f"{AFTER_INIT}{lines}")(literal)
    (outcome,) = examine(Order(literal.parent, underlay, ["4.4"]))
    assert outcome.passed, (first_wrong(outcome), outcome.trouble)


@claim("The checker writes through no link that a program planted")
def test_a_link_planted_where_the_checker_writes_is_not_followed(
    literal, bare_underlay, scratch, monkeypatch
):
    """Without isolation, where the link leads somewhere."""
    monkeypatch.setattr(bubblewrap, "granted", bubblewrap.Isolation)
    plant = PLANTS_LINKS.format(aim=f"{scratch}/planted")
    put(TALKER, "import rospy\n", f"import rospy\n{plant}", 1)(literal)
    (outcome,) = examine(Order(literal.parent, bare_underlay, ["3"]))
    assert "C9" in [result.id for result in outcome.results]
    assert not os.path.lexists(f"{scratch}/planted")


@claim("Programs that fork, kill, fill, print ...", because="a talker")
def test_a_hostile_talker_harms_none_beside_or_after_it(literal, underlay, tmp_path, scratch):
    """Two at a time, as with check --all: a right one before and after each hostile one."""
    students = [tmp_path / "right_0"]
    shutil.copytree(literal.parent, students[0])
    for number, (program, _) in enumerate(TALKERS.values(), 1):
        students += [tmp_path / f"hostile_{number}", tmp_path / f"right_{number}"]
        for student in students[-2:]:
            shutil.copytree(literal.parent, student)
        write(TALKER, FIRST + program)(students[-2] / "src")
    with ThreadPoolExecutor(2) as pool:
        orders = [Order(student, underlay, ["3"]) for student in students]
        wrong = [first_wrong(*outcomes) for outcomes in pool.map(examine, orders)]
    assert wrong[::2] == [(None, "")] * (len(TALKERS) + 1)
    for (check, report), (_, words) in zip(wrong[1::2], TALKERS.values()):
        assert check == "C6" and words in report, report
    assert not processes_like(f"{scratch}/")
