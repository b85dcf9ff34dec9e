"""A stored recording is old after a change of what its recorder imports, and only then."""

import pytest
from recorder_code import closure, modules_of

from tutorial_testing.claims import claim

SECTIONS = ("talker_listener", "driving", "launch_files", "world")
RECORDERS = [f"courses.handout.{section}.record" for section in SECTIONS]


@pytest.mark.parametrize("recorder", RECORDERS)
def test_a_change_of_a_check_or_a_report_makes_no_recording_old(recorder):
    later = ("tutorial_check.checking", "tutorial_check.report", "tutorial_check.commands")
    assert not [name for name in closure(recorder) if name.startswith(later)]


@claim("Every row of mistakes ...", because="what counts as the recorders of today")
@pytest.mark.parametrize("recorder", RECORDERS)
def test_a_change_of_what_runs_programs_or_reads_them_makes_recordings_old(recorder):
    checker = ("processes.runner", "processes.cpu_clock", "submission.python_facts")
    imported_later = ("recording.peer", "recording.virtual_gamepad")  # within functions
    needed = {f"tutorial_check.{name}" for name in (*checker, *imported_later)}
    needed |= {recorder, "courses.handout.task", "gamepad.io.pads"}
    assert needed <= closure(recorder)


@pytest.mark.parametrize(("base", "name", "modules"), [
    ("tutorial_check", "Wrong", ["tutorial_check.checking.results"]),
    ("tutorial_check.recording", "peer", ["tutorial_check.recording.peer"]),
    ("tutorial_check.recording.peer", "Peer", ["tutorial_check.recording.peer"]),
    ("tutorial_check", None, ["tutorial_check"]),
    ("os.path", "join", []),
    ("rospy", "Time", []),
    ("kobuki_msgs.msg", "BumperEvent", []),
    ("none.such", "name", []),
])  # fmt: skip
def test_a_name_stands_for_the_module_that_defines_it(base, name, modules):
    assert modules_of(base, name) == modules


def test_a_change_of_what_chooses_the_next_joy_makes_recordings_old():
    driving = "courses.handout.driving"
    chosen_by = {f"{driving}.{name}" for name in ("evidence", "joys", "replies", "joy2twist_run")}
    assert chosen_by <= closure(f"{driving}.record")
