"""OTHER_PROGRAMS.md: each line, with programs of the same imports, topics and timing.

They are those of other_programs/, a package in a student's workspace, in our own words.
"""

import contextlib
import math
import re
import shlex
import shutil
import subprocess
import time
from typing import NamedTuple

import pytest

from tutorial_check.checking import causes
from tutorial_testing.claims import claim
from tutorial_testing.keys import Tmux
from tutorial_testing.processes import REPOSITORY, Program, free_port
from tutorial_testing.robot import OBSERVER, PERIOD_S, Robot
from tutorial_testing.waiting import Stopwatch, lost_s, wait_for

# All of them use the same robots.
pytestmark = [pytest.mark.xdist_group("others"), pytest.mark.long]
TUTORIAL = str(REPOSITORY / "tutorial")
PAGE = (REPOSITORY / "common/doc/OTHER_PROGRAMS.md").read_text(encoding="utf-8")
LAUNCH = {
    "rbx1": ("rbx1_bringup", "fake_turtlebot.launch"),
    "TurtleBot": ("turtlebot_bringup", "minimal.launch", "world:=room"),
}
# What the user must first do to a program: in the words of the page, and as a command.
HOW = {
    "as it is": "true",
    "`2to3`": "2to3 -w {0}",
    "`expand`": "expand -i {0} > new && cat new > {0}",
}
LEG_S = 6.0  # about the shortest drive of a program
TO_MUX = "cmd_vel:=cmd_vel_mux/input/teleop"
JOY = "rostopic pub -r 20 joy sensor_msgs/Joy '{axes: [0, 0.4], buttons: [1]}'"
PUSH = "rosrun others sender cmd_vel_mux/input/navi 10 60,0.6,0"
ARC = "rosrun others sender cmd_vel_mux/input/navi 10 1,0.2,0.6"


class Row(NamedTuple):
    """A program for these lines of the page; it drives [m] and turns [rad] this far, or prints."""

    names: str
    robot: str
    command: str
    metres: float = 0.0
    radians: float = 0.0
    prints: str = ""
    how: str = "as it is"
    beside: str = "true"  # another command


ROWS = [
    Row("timed_out_and_back.py", "rbx1", "sender /cmd_vel 50 2,0.2,0 1,0,1 2,0.2,0", 0.68, 0.9),
    Row("voice_nav.py", "rbx1", "voice", 0.3,
        beside="rostopic pub -r 2 recognizer/output std_msgs/String forward"),
    Row("odom_out_and_back.py nav_square.py", "rbx1", "by_tf", 0.38, 0.95),
    Row("calibrate_linear.py calibrate_angular.py static_transform_publisher tf_echo"
        " simple_action_client.py simple_action_server.py", "rbx1", "imports", prints="all there"),
    Row("teleop_twist_joy", "rbx1", "teleop_joy", 0.3, beside=JOY),
    Row("red_light_green_light.py test_forwardbackward.py", "TurtleBot",
        f"sender cmd_vel 2 6,0.05,0 6,-0.05,0 {TO_MUX}", 0.53),
    Row("goforward.py draw_a_square.py kobuki_battery.py kobuki_buttons.py", "TurtleBot",
        "sender cmd_vel_mux/input/navi 5 2,0.2,0 2,0,0.785", 0.3, 1.4, how="`expand`"),
    Row("motion_square.py", "TurtleBot", "square", 0.05, 0.7, beside=ARC),
    Row("wander.py", "TurtleBot", f"wander {TO_MUX}", 0.5, 0.5),
    Row("test_events.py test_led_array.py test_sounds.py key_publisher.py keys_to_twist.py",
        "TurtleBot", "events", prints="(?s)(?=.*all shown)(?=.*not charging).*bumper pressed",
        how="`2to3`", beside=PUSH),
]  # fmt: skip
# In a terminal, with keys.
KEYBOARD = Row("teleop_twist_keyboard.py", "TurtleBot", f"teleop {TO_MUX}")
# Programs that wait without end.
PLANNED = ("move_base_square.py", "goforward_and_avoid_obstacle.py", "follow_the_route.py")
WAIT = {**dict.fromkeys(PLANNED, "waits for move_base"), "follower.py": "waits for a camera"}


class Place(Robot):
    """A robot and its observer with a separate master, and a student's shell there."""

    def __init__(self, folder, robot):
        super().__init__()
        self._folder, self.scripts = str(folder), folder / "src/others/scripts"
        self._launch = LAUNCH[robot]
        self.environment = {"ROS_MASTER_URI": f"http://localhost:{free_port()}"}

    def begin(self):
        launch = Program(TUTORIAL, "run", "roslaunch", *self._launch, **self.environment)
        self._stack.enter_context(launch)
        wait_for(lambda: "started core service" in launch.output, "master")
        self.observe(OBSERVER, **self.environment)

    def command(self, line):
        words = ("run", "--in", self._folder, "bash", "-ec", f"cd {self.scripts}; {line}")
        return (TUTORIAL, *words)

    def start(self, line):
        return Program(*self.command(line), **self.environment)

    def run(self, line):
        with self.start(line) as program:
            assert program.wait() == 0, program.output
            return program.output

    def way_since(self, begin):
        """Return how far it has driven [m] and turned [rad] since this index of its odometry."""
        poses = [moment.pose for moment in self.odometry[begin:]]
        steps = list(zip(poses, poses[1:]))
        metres = sum(math.dist(old[:2], new[:2]) for old, new in steps)
        return metres, sum(abs(math.remainder(new[2] - old[2], math.tau)) for old, new in steps)

    def prepare(self, row):
        """Do what the page says, which Python 3 needs to read the program."""
        path = self.scripts / row.command.split()[0]
        if row.how == "`expand`" and path.name == "sender":
            path.write_text(re.sub("^ {8}(?=self|rate)", "\t", path.read_text(), flags=re.M))
        self.run(HOW[row.how].format(path))


@pytest.fixture(scope="module")
def places(tmp_path_factory):
    folder = tmp_path_factory.mktemp("others") / "catkin_ws"
    shutil.copytree(REPOSITORY / "test/suite/system/other_programs", folder / "src/others")
    with Program(TUTORIAL, "run", "--in", str(folder), "catkin_make", "-C", str(folder)) as made:
        assert made.wait() == 0, made.output
    with contextlib.ExitStack() as stack:
        yield {name: stack.enter_context(Place(folder, name)) for name in LAUNCH}


@claim("OTHER_PROGRAMS.md: each line drives or prints by a program of the same imports")
@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.names)
def test_a_program_drives_or_prints_what_it_does_on_a_robot(row, places):
    place = places[row.robot]
    place.prepare(row)
    begin, watch = len(place.odometry), Stopwatch()

    def done():
        metres, radians = place.way_since(begin)
        # A program that drives by time drives less far on a busy machine.
        share = max(0.2, 1 - watch.lost_s / LEG_S)
        enough = metres >= share * row.metres and radians >= share * row.radians
        return enough and re.search(row.prints, it.output)

    with place.start(row.beside), place.start(f"rosrun others {row.command}") as it:
        wait_for(done, f"effect of {row.command}", 60, lambda: it.output)
        assert "Traceback" not in it.output
    if row.robot == "rbx1":  # obeys the last command until the next one
        place.run("rostopic pub -1 cmd_vel geometry_msgs/Twist '{}'")
    place.wait_for_rest()


@claim("A key that is held drives without a break")
def test_a_key_that_x11_repeats_drives_without_a_break(places):
    place = places[KEYBOARD.robot]
    command = place.command(f"rosrun others {KEYBOARD.command}")
    terminal = Tmux(shlex.join(["env", *map("=".join, place.environment.items()), *command]))
    wait_for(lambda: "Moving around" in terminal.screen, "program")
    begin, until = len(place.odometry), time.monotonic() + 3
    lost = lost_s()
    terminal.press("i")
    time.sleep(0.66)  # X11's delay until a held key repeats
    while time.monotonic() < until:
        terminal.press("i")
        time.sleep(0.03)
    lost = (lost_s() - lost) / PERIOD_S
    terminal.hold("s", lambda: not place.now.moves, "robot at rest")
    terminal.close()
    moving = "".join("-M"[moment.moves] for moment in place.odometry[begin:]).strip("-")
    assert len(moving) + lost > 1.5 / PERIOD_S, moving
    assert moving.count("M") + lost > 0.8 * len(moving), moving


def lines():
    """Return {name: its columns} of the page's tables; names are in backticks."""
    rows = [line.split("|")[1:-1] for line in PAGE.splitlines() if line.startswith("| `")]
    return {name: row for row in rows for name in re.findall(r"`([^`]+)`", row[0])}


def packages(what):
    """Return the names of the ROS packages for which the page says this."""
    return {name for name, row in lines().items() if row[1].strip() == what}


@claim("OTHER_PROGRAMS.md: each line ...", because="each line")
def test_each_line_of_the_page_is_run_here():
    said = {name: (row.how, row.robot) for row in (*ROWS, KEYBOARD) for name in row.names.split()}
    said.update({name: (why, "") for name, why in WAIT.items()})
    assert set(lines()) == set(said) | packages("here already") | packages("not in Debian")
    for name, (how, robot) in said.items():
        assert how in lines()[name][1] and robot in lines()[name][2], name


@claim("What Debian lacks, what takes its place, and what nobody serves")
def test_what_debian_lacks_and_what_takes_its_place(places):
    topics = places["TurtleBot"].run("rostopic list")
    assert "move_base" not in topics and "camera/rgb" not in topics
    missing, here = packages("not in Debian"), set(places["rbx1"].run("rospack list-names").split())
    assert not missing & here and packages("here already") <= here
    for name in missing:
        assert causes.advice(name, "") == f"Debian lacks {name}; {lines()[name][2].strip()}"
    missing |= set(causes.TABLES["REAL"].split())
    forms = ("{}", "ros-{}", "python3-{}", "lib{}-dev")
    assert not shown(*(f.format(name.replace("_", "-")) for name in missing for f in forms))


def shown(*packages):
    command = ("apt-cache", "show", "--no-all-versions", *packages)
    text = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    return set(re.findall(r"^Package: (\S+)$", text, re.MULTILINE))


@claim("Debian has each package that a hint names")
def test_debian_has_what_hints_name():
    tables = (causes.OTHER_MODULES, causes.OTHER_PACKAGES)
    listed = [row.partition(":")[0].replace("*", "") for t in tables for row in t.splitlines()]
    names = " ".join([*listed, causes.MODULES, causes.DEV_PACKAGES]).split()
    packages = {causes.package_of_module(name) for name in names} - {""}
    packages |= {package for name in names for package in causes.packages_of_ros(name).split()}
    assert shown(*packages) == packages
