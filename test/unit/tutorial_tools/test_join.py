"""What join reports before it starts anything."""

import pytest

from node_kit.questions import Answer
from tutorial_tools import join
from tutorial_tools.join import JoinError, check_host, check_master, check_robot

URI, OWN = "http://10.0.0.1:11311", "10.0.0.2"


@pytest.mark.parametrize("host", ["http://10.0.0.1:11311", "a b", "", "host:x"])
def test_a_malformed_host(host):
    with pytest.raises(JoinError, match="must be a machine's name or address"):
        check_host(host)


def test_this_machine_needs_no_way_out():
    assert check_host("127.0.0.1") == ("http://127.0.0.1:11311", "127.0.0.1")
    assert check_host("127.0.0.1:11999") == ("http://127.0.0.1:11999", "127.0.0.1")


def test_an_unknown_name(monkeypatch):
    monkeypatch.setattr(join, "addresses", lambda name: [])
    with pytest.raises(JoinError, match="cannot be looked up"):
        check_host("teacher")


def answers(monkeypatch, value, answer=Answer.WELL, reached=True):
    """Let the master answer every question so."""
    monkeypatch.setattr(join, "call", lambda *_: (answer, value))
    monkeypatch.setattr(join, "is_called_back", lambda *_: reached)


@pytest.mark.parametrize(
    ("answer", "reached", "line"),
    [
        (Answer.REFUSED, True, "has the teacher started"),
        (Answer.WELL, False, r"does not reach this machine at 10\.0\.0\.2"),
    ],
)
def test_no_master_or_one_behind_a_firewall(monkeypatch, answer, reached, line):
    answers(monkeypatch, 1, answer, reached)
    with pytest.raises(JoinError, match=line):
        check_master(URI, OWN)


@pytest.mark.parametrize("run_id", ["../../tmp", "a/b", "", "..", 5, ["a"], "a\x1b[2J", "\n"])
def test_a_folder_for_logs_somewhere_else(monkeypatch, run_id):
    answers(monkeypatch, run_id)
    with pytest.raises(JoinError, match="/run_id that is no name") as error:
        check_master(URI, OWN)
    assert str(error.value).isprintable()
    answers(monkeypatch, "6a5f-01")
    check_master(URI, OWN)


def test_which_robots_there_are(monkeypatch):
    publishers = [["/robot_2/cmd_vel", ["/robot_2/myjoystick2twist"]]]
    subscribers = [["/robot_1/cmd_vel", ["/classroom"]], ["/robot_2/cmd_vel", ["/classroom"]]]
    answers(monkeypatch, [publishers, subscribers, []])
    check_robot(URI, "robot_1")
    with pytest.raises(JoinError, match="there are robot_1, robot_2"):
        check_robot(URI, "robot_7")
    with pytest.raises(JoinError, match="driven already, by /robot_2/myjoystick2twist"):
        check_robot(URI, "robot_2")


@pytest.mark.parametrize(
    "state",
    [
        5,
        [[], []],
        [[["/a"]], [], []],
        [[], [[5, ["/a"]]], []],
        [[], [["/robot_1/cmd_vel", 5]], []],
        [[["/robot_1/cmd_vel", [5]]], [["/robot_1/cmd_vel", []]], []],
        [[["/robot_1/cmd_vel", ["\x1b[2J"]]], [["/robot_1/cmd_vel", []]], []],
        [[[["/a"], []]], [], []],
        {},
    ],
)
def test_a_master_that_answers_nonsense(monkeypatch, state):
    answers(monkeypatch, state)
    with pytest.raises(JoinError, match="does not answer as one of ROS"):
        check_robot(URI, "robot_1")


@pytest.mark.parametrize(
    ("argument", "line"),
    [
        ("virtul:=true", "virtul:=true: not an argument of student.launch, "),
        ("virtual:=yes", "virtual:=yes: must be true or false"),
        ("bag:=/no/such", "bag:=/no/such: cannot be read: No such file or directory"),
        ("name:=robot_8", "name:=robot_8: the name is robot_7 already"),
    ],
)
def test_a_wrong_argument_is_one_line_before_the_master_is_asked(
    monkeypatch, capsys, argument, line
):
    monkeypatch.setattr("sys.argv", ["join", "10.0.0.1", "robot_7", argument])
    with pytest.raises(SystemExit) as end:
        join.main()
    assert end.value.code == 2
    (said,) = capsys.readouterr().err.splitlines()
    assert said.startswith(f"tutorial: join: {line}")
