"""What join says before it starts anything."""

import pytest

from node_kit.questions import Answer
from tutorial_tools.join import program
from tutorial_tools.join.program import (
    JoinError,
    check_host,
    check_master,
    check_robot,
    check_run_id,
)


def test_a_host_that_is_none():
    for host in ("http://10.0.0.1:11311", "a b", "", "host:x"):
        with pytest.raises(JoinError, match="must be a machine's name or address"):
            check_host(host)


def test_this_machine_needs_no_way_out():
    assert check_host("127.0.0.1") == ("http://127.0.0.1:11311", "127.0.0.1")
    assert check_host("127.0.0.1:11999") == ("http://127.0.0.1:11999", "127.0.0.1")


def test_a_name_that_nobody_knows(monkeypatch):
    monkeypatch.setattr(program, "addresses", lambda name: [])
    with pytest.raises(JoinError, match="cannot be looked up"):
        check_host("teacher")


def test_no_master_there(monkeypatch):
    monkeypatch.setattr(program, "call", lambda *_: (Answer.REFUSED, None))
    with pytest.raises(JoinError, match="has the teacher started"):
        check_master("http://10.0.0.1:11311", "10.0.0.2")


def test_a_master_that_does_not_reach_us(monkeypatch):
    monkeypatch.setattr(program, "call", lambda *_: (Answer.WELL, 1))
    monkeypatch.setattr(program, "is_called_back", lambda *_: False)
    with pytest.raises(JoinError, match=r"does not reach this machine at 10\.0\.0\.2"):
        check_master("http://10.0.0.1:11311", "10.0.0.2")


def test_which_robots_there_are(monkeypatch):
    publishers = [["/robot_2/cmd_vel", ["/robot_2/myjoystick2twist"]]]
    subscribers = [["/robot_1/cmd_vel", ["/classroom"]], ["/robot_2/cmd_vel", ["/classroom"]]]
    monkeypatch.setattr(program, "call", lambda *_: (Answer.WELL, [publishers, subscribers, []]))
    check_robot("http://10.0.0.1:11311", "robot_1")
    with pytest.raises(JoinError, match="there are robot_1, robot_2"):
        check_robot("http://10.0.0.1:11311", "robot_7")
    with pytest.raises(JoinError, match="driven already, by /robot_2/myjoystick2twist"):
        check_robot("http://10.0.0.1:11311", "robot_2")


@pytest.mark.parametrize(
    ("argument", "line"),
    [
        ("virtual=true", r"virtual=true: .* did you mean virtual:=true\?"),
        ("virtul:=true", r"virtul:=true: not an argument of student.launch, .* mean virtual:=\?"),
        ("virtual:=yes", "virtual:=yes: must be true or false"),
        ("bag:=/no/such", "bag:=/no/such: cannot be read: No such file or directory"),
        ("name:=robot_8", "name:=robot_8: the name is robot_7 already"),
    ],
)
def test_a_wrong_argument_is_one_line_before_the_master_is_asked(monkeypatch, argument, line):
    monkeypatch.setattr("sys.argv", ["join", "10.0.0.1", "robot_7", argument])
    with pytest.raises(SystemExit, match=f"^join: {line}$"):
        program.main()


@pytest.mark.parametrize(
    "state",
    [
        5,
        "no",
        [],
        [[], []],
        [[], [], [], []],
        [5, [], []],
        [[5], [], []],
        [[["/a"]], [], []],
        [[], [[5, ["/a"]]], []],
        [[], [["/robot_1/cmd_vel", 5]], []],
        [[["/robot_1/cmd_vel", [5]]], [["/robot_1/cmd_vel", []]], []],
        [[["/robot_1/cmd_vel", ["\x1b[2J"]]], [["/robot_1/cmd_vel", []]], []],
        [[[["/a"], []]], [], []],
        {},
    ],
)
def test_a_master_that_talks_nonsense(monkeypatch, state):
    monkeypatch.setattr(program, "call", lambda *_: (Answer.WELL, state))
    with pytest.raises(JoinError, match="does not answer as one of ROS"):
        check_robot("http://10.0.0.1:11311", "robot_1")


@pytest.mark.parametrize("run_id", ["../../tmp", "a/b", "", "..", 5, ["a"], "a\x1b[2J", "\n"])
def test_a_folder_for_logs_somewhere_else(monkeypatch, run_id):
    monkeypatch.setattr(program, "call", lambda *_: (Answer.WELL, run_id))
    with pytest.raises(JoinError, match="/run_id that is no name") as error:
        check_run_id("http://10.0.0.1:11311")
    assert str(error.value).isprintable()


@pytest.mark.parametrize(
    "answer", [(Answer.WELL, "6a5f-01"), (Answer.WELL, "classroom"), (Answer.STRANGE, None)]
)
def test_a_run_id_or_none(monkeypatch, answer):
    monkeypatch.setattr(program, "call", lambda *_: answer)
    check_run_id("http://10.0.0.1:11311")
