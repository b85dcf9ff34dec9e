"""What common/doc/CONTAINER.md promises, on a real engine, with a browser on its host."""

import contextlib
import json
import os
import re
import shutil
import socket
import subprocess
import urllib.error
import urllib.request
import zipfile
from pathlib import Path

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.hands import Keys
from tutorial_testing.processes import Program, free_port
from tutorial_testing.robot import OBSERVER, Robot
from tutorial_testing.waiting import DEADLINE_S, wait_for

pytestmark = claim("Classroom, two hosts, devcontainer and autograder run in containers")
SOURCE = Path(os.environ.get("CHECKED_SOURCE") or Path(__file__).resolve().parents[3])
INSIDE = "/home/student/ros1_tutorial"
PORT = free_port()  # 8080 may be another test's
PAGE = f"http://localhost:{PORT}/"
WITH_TESTS = f'PYTHONPATH=$PYTHONPATH:{INSIDE}/test/support exec "$@"'
LARGEST = 1e9  # bytes
START_S = 60.0
STUDENT = 4321  # a uid of the host that the image does not have
MAKE = "catkin_create_pkg beginner_tutorials std_msgs rospy roscpp"
NEIGHBOUR = """
import urllib.request, urllib.error
request = urllib.request.Request("http://%s:8080/", headers={"Host": "localhost"})
try: print(urllib.request.urlopen(request).status)
except urllib.error.HTTPError as error: print(error.code)"""


def run(*command, text="", **environment):
    """Run a command; return its output. AssertionError if it fails. text: its standard input."""
    done = subprocess.run(
        command, env={**os.environ, **environment}, cwd=SOURCE, text=True, timeout=300, input=text,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
    )  # fmt: skip
    if done.returncode:  # an assert statement would escape the newlines
        raise AssertionError(f"{' '.join(command)}: {done.returncode}\n{done.stdout}")
    return done.stdout


class Compose:
    """The services of a file in docker/: a context manager that ends them."""

    def __init__(self, file="compose.yaml", **environment):
        self._command = ("docker-compose", "-f", f"docker/{file}")
        self._environment = {"COCKPIT_PORT": str(PORT), **environment}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(AssertionError):
            self("down", "--timeout", "5")

    def __call__(self, *words):
        return run(*self._command, *words, **self._environment)

    def container(self, service):
        return self("ps", "-q", service).split()[-1]


class RobotInside(Robot):
    def __init__(self, container):
        super().__init__()
        inside = ("./tutorial", "run", "bash", "-c", WITH_TESTS, "-")
        self._inside = ("docker", "exec", "-i", container, *inside)

    def begin(self):
        wait_for(self._answers, "the simulated robot in the container")
        self.observe([*self._inside, *OBSERVER])

    def _answers(self):
        command = [*self._inside, "rosnode", "ping", "-c", "1", "/fake_turtlebot"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        return "time=" in done.stdout


def status(**headers):
    """Return the status of a request for the page; None if nothing answers."""
    try:
        request = urllib.request.Request(PAGE, headers=headers)
        with urllib.request.urlopen(request, timeout=10) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        return error.code
    except OSError:
        return None


def wait_for_page(browser):
    wait_for(lambda: status() == 200, "page", START_S)
    browser.open(PAGE)


def wait_for_movement(call, *terminal, robot=""):
    """Wait until a robot moves, as rostopic shows in a terminal."""
    echo = (*terminal, "rostopic", "echo", "-n", "1", f"{robot}/odom/twist/twist/linear/x")

    def moves():
        with contextlib.suppress(AssertionError):  # its master does not run yet
            return "0.0" not in call(*echo).splitlines()
        return False

    wait_for(moves, f"movement of {robot}", DEADLINE_S)


def ends_by_itself(container):
    """Return whether a container ends when asked to, so that the engine need not kill it."""
    run("docker", "stop", "--time", "60", container)
    return run("docker", "inspect", "-f", "{{.State.ExitCode}}", container).strip() != "137"


@claim("The image is small, and not root's")
def test_the_image_is_small_and_its_user_is_not_root():
    about = json.loads(run("docker", "image", "inspect", "ros1_tutorial"))[0]
    assert about["Size"] <= LARGEST
    assert about["Config"]["User"] == "student"
    assert about["Config"]["Healthcheck"] and about["Config"]["Labels"]


@claim("A container shows a moving robot on its host alone, and its page drives")
def test_up_shows_a_moving_robot_on_this_host_alone():
    with Compose() as compose, Chromium() as browser:
        compose("up", "-d")
        wait_for_page(browser)
        row = wait_for(lambda: browser.text("#robots tr"), "robot", START_S)
        wait_for(lambda: browser.text("#robots tr") != row, "movement on the page", START_S)
        assert PAGE in compose("logs")

        interfaces = json.loads(run("ip", "-json", "-4", "address"))
        addresses = {entry["local"] for given in interfaces for entry in given["addr_info"]}
        for address in addresses - {"127.0.0.1"}:
            with pytest.raises(OSError):
                socket.create_connection((address, PORT), 2).close()
        assert status(Host="evil.example:8080") == status(Origin="http://evil.example") == 403
        container = compose.container("demo")
        network = run("docker", "inspect", "-f", "{{.HostConfig.NetworkMode}}", container).strip()
        python = ("ros1_tutorial", "/usr/bin/python3", "-c", NEIGHBOUR % container[:12])
        assert run("docker", "run", "--rm", "--network", network, *python).strip() == "403"

        assert ends_by_itself(container)


@claim("A container shows ...", because="its page")
def test_the_page_drives_and_the_robot_rests_when_it_is_let_go_or_all_ends():
    with Compose() as compose, Chromium() as browser:
        compose("up", "-d", "drive")
        with RobotInside(compose.container("drive")) as robot:
            wait_for_page(browser)
            hands = Keys(browser)
            x = robot.now.x
            hands.drive(robot, until=lambda: robot.now.x > x + 0.2)
            hands.release()
            robot.wait_for_rest()
            hands.drive(robot)
            compose("stop")
            assert not robot.now.moves


@pytest.fixture
def workspace(tmp_path):
    tmp_path.chmod(0o755)
    for folder in tmp_path.parents:
        if folder.stat().st_uid == os.geteuid() and folder.name.startswith("pytest"):
            folder.chmod(0o755)
    folder = tmp_path / "catkin_ws"
    folder.mkdir()
    if os.geteuid() == 0:
        os.chown(folder, STUDENT, STUDENT)
    return folder


@claim("A student's workspace stays the student's; terminals begin there")
def test_a_students_workspace_stays_the_students(workspace):
    owner = workspace.stat().st_uid
    exercise = f"""cd ~/catkin_ws/src && {MAKE} &&
        cd .. && catkin_make >/dev/null && tutorial check --no-hints 2 3"""
    with Compose(CATKIN_WS=str(workspace), STUDENT=f"{owner}:{owner}") as compose:
        shell = ("run", "--rm", "-T", "shell", "tutorial", "run", "--in", ".")
        with pytest.raises(AssertionError) as wrong:
            compose(*shell, "bash", "-c", exercise)
        inside = str(wrong.value)
    assert re.search("isolated by Landlock alone|no isolation here", inside)
    assert {path.lstat().st_uid for path in workspace.rglob("*")} == {owner}
    assert re.search(r"^  ok +C\d+", inside, re.M) and re.search(r"^  WRONG +C\d+", inside, re.M)


@claim("A student's workspace stays the student's; terminals begin there", because="terminals")
def test_a_terminal_starts_in_the_workspace_and_ends_at_once(workspace):
    owner = workspace.stat().st_uid
    if owner == STUDENT:  # the image's own user may not write there
        with Compose(CATKIN_WS=str(workspace)) as compose, pytest.raises(AssertionError) as wrong:
            compose("run", "--rm", "-T", "shell")
        assert f"export STUDENT={owner}:{owner}" in str(wrong.value)
    with Compose(CATKIN_WS=str(workspace), STUDENT=f"{owner}:{owner}") as compose:
        compose("run", "-d", "--name", "course", "shell")
        wait_for(lambda: "tutorial check" in run("docker", "logs", "course"), "shell", START_S)
        where = run("docker", "exec", "course", "tutorial", "run", "--in", ".", "pwd")
        assert where.splitlines()[-1] == "/home/student/catkin_ws"
        assert ends_by_itself("course")
        compose("down")
        assert "course" not in run("docker", "ps", "--all")


def test_a_classroom_and_a_student_in_further_terminals(workspace):
    with Compose(CATKIN_WS=str(workspace)) as compose:
        classroom = ["tutorial", "run", "roslaunch", "cockpit", "classroom.launch", "robots:=3"]
        compose("run", "-d", "--name", "course", "shell", *classroom)
        try:
            terminal = ("docker", "exec", "-i", "course", "tutorial", "run")
            wait_for(lambda: "cockpit: open" in run("docker", "logs", "course"), "page", START_S)
            student = "roslaunch joy2twist student.launch name:=robot_2 loop:=true bag:="
            bag = f"{INSIDE}/common/gamepad/bag/joy.bag"
            with Program(*terminal, *f"{student}{bag}".split()):
                wait_for_movement(run, *terminal, robot="/robot_2")
        finally:
            run("docker", "rm", "--force", "course")


def test_robot_and_workstation_in_two_containers_drive():
    with Compose("two_hosts.yaml") as compose:
        compose("up", "-d")
        wait_for_movement(compose, "exec", "-T", "workstation", "./tutorial", "run")


@pytest.mark.night
@pytest.mark.skipif(not shutil.which("npx"), reason="npx (package npm) starts @devcontainers/cli")
def test_the_devcontainer_checks_a_workspace_and_serves_the_page():
    tool = ("npx", "--yes", "@devcontainers/cli@0.89.0")
    up = json.loads(run(*tool, "up", "--workspace-folder", str(SOURCE)).splitlines()[-1])
    try:
        inside = (*tool, "exec", "--workspace-folder", str(SOURCE))
        workspace = "/home/student/ws"
        run(*inside, "./tutorial", "run", "--in", workspace, "bash", "-c", f"cd ~/ws/src && {MAKE}")
        checked = run(*inside, "./tutorial", "check", "--in", workspace, "2")
        assert "1 of 1 exercises done" in checked
        terminal = run(*inside, "bash", "-i", text="rospack find joy2twist; exit\n")
        assert "/joy2twist\n" in terminal.replace("\r", "")
        with Program(*inside, "./tutorial", "demo") as demo:
            wait_for(lambda: "first /odom" in demo.output, "demo", START_S)
            page = 'import urllib.request as r; print(r.urlopen("http://127.0.0.1:8080/").status)'
            wait_for(lambda: "200" in run(*inside, "/usr/bin/python3", "-c", page), "page", START_S)
    finally:
        run("docker", "rm", "--force", up["containerId"])


@pytest.mark.night
def test_gradescopes_autograder_as_the_service_runs_it(tmp_path):
    """Its scripts, in its folders, as root, in an image that has the Debian packages already."""
    autograder = tmp_path / "autograder"
    for name in ("source", "results"):
        (autograder / name).mkdir(parents=True)
    file = tmp_path / "autograder.zip"
    run(str(SOURCE / "tutorial"), "check", "--package", "gradescope", "--out", str(file), "2", "3")
    with zipfile.ZipFile(file) as packed:
        for about in packed.infolist():  # as unzip does, with their permissions
            path = packed.extract(about, autograder / "source")
            os.chmod(path, about.external_attr >> 16 & 0o777)
    shutil.copytree(SOURCE / "test/tutorial_check/exercises/literal", autograder / "submission")
    talker = autograder / "submission/beginner_tutorials/scripts/talker.py"
    inside = ("docker", "run", "--rm", "--user", "root", "--env", "HOME=/root")
    inside += ("-v", f"{autograder}:/autograder", "ros1_tutorial", "bash", "-c")
    results = autograder / "results/results.json"

    def scores():
        tests = json.loads(results.read_text())["tests"]
        results.unlink()
        return [test["score"] for test in tests]

    run(*inside, "/autograder/source/setup.sh && /autograder/source/run_autograder")
    right = scores()
    assert len(right) > 8 and set(right) == {1}, right
    talker.write_text(talker.read_text().replace("rospy.init_node", "rospy.initnode"))
    run(*inside, "/autograder/source/run_autograder")  # the program is wrong, not the autograder
    assert 0 in scores()
