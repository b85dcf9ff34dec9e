"""What join refuses before it starts a launch."""

import pytest

from node_kit.rules.answer import Answer
from tutorial_testing.claims import claim
from tutorial_tools.classroom import check_robot
from tutorial_tools.errors import JoinError
from tutorial_tools.ros import join
from tutorial_tools.ros.join import check_host, check_master

pytestmark = claim("join refuses a host, a master and a robot in one line each")
URI, OWN = "http://10.0.0.1:11311", "10.0.0.2"


@pytest.mark.parametrize(("host", "line"), [
    *((host, "must be a machine's name or address") for host in (URI, "a b", "", "host:x")),
    ("teacher", "cannot be looked up"),
])  # fmt: skip
def test_a_host_that_cannot_be_one(monkeypatch, host, line):
    monkeypatch.setattr(join, "addresses", lambda name: [])
    with pytest.raises(JoinError, match=line):
        check_host(host)


ROBOT, DRIVEN = "/robot_1/cmd_vel", "/robot_2/cmd_vel"
DRIVER = "/robot_2/myjoystick2twist"
STATE = [[[DRIVEN, [DRIVER]]], [[ROBOT, ["/classroom"]], [DRIVEN, ["/classroom"]]], []]
NONSENSE = 5, [[], [[ROBOT, 5]], []], [[[ROBOT, ["\x1b[2J"]]], [[ROBOT, []]], []]
RUN_IDS = ("../../tmp", "..", 5, "a\x1b[2J")


@pytest.fixture
def answers(monkeypatch):
    def answer(value, answer=Answer.WELL, reached=True):
        monkeypatch.setattr(join, "call", lambda *_: (answer, value))
        monkeypatch.setattr(join, "is_called_back", lambda *_: reached)

    return answer


@pytest.mark.parametrize(("given", "line"), [
    ((1, Answer.REFUSED), "has the teacher started"),
    ((1, Answer.WELL, False), "does not reach this machine at 10.0.0.2"),
    *(((run_id,), "has a /run_id that is no name") for run_id in RUN_IDS),  # names a folder
])  # fmt: skip
def test_a_master_that_is_refused(answers, given, line):
    answers(*given)
    with pytest.raises(JoinError) as error:
        check_master(URI, OWN)
    assert line in str(error.value) and str(error.value).isprintable()


@pytest.mark.parametrize(("state", "name", "line"), [
    (STATE, "robot_7", "there are robot_1, robot_2"),
    (STATE, "robot_2", f"driven already, by {DRIVER}"),
    *((state, "robot_1", "does not answer as one of ROS") for state in NONSENSE),
])  # fmt: skip
def test_a_robot_that_is_refused(state, name, line):
    with pytest.raises(JoinError, match=line):
        check_robot(URI, state, name)


def test_a_host_a_master_and_a_robot_that_are_free(answers):
    assert check_host("127.0.0.1:11999") == ("http://127.0.0.1:11999", "127.0.0.1")
    answers("6a5f-01")
    check_master(URI, OWN)
    check_robot(URI, STATE, "robot_1")


@claim("A mistake in join's arguments is reported before the master is asked")
@pytest.mark.parametrize(("argument", "line"), [
    ("virtul:=true", "virtul:=true: not an argument of student.launch, "),
    ("bag:=/no/such", "bag:=/no/such: cannot be read: No such file or directory"),
    ("name:=robot_8", "name:=robot_8: the name is robot_7 already"),
])  # fmt: skip
def test_a_wrong_argument_is_one_line_before_the_master_is_asked(
    monkeypatch, capsys, argument, line
):
    monkeypatch.setattr("sys.argv", ["join", "10.0.0.1", "robot_7", argument])
    with pytest.raises(SystemExit) as end:
        join.main()
    assert end.value.code == 2
    (said,) = capsys.readouterr().err.splitlines()
    assert said.startswith(f"tutorial: join: {line}")
