"""A robot that a form moves stops when the cockpit, its master or the page ends.

This holds even for a robot without a timeout, as in launch_bag.launch.
"""

import contextlib
import math
import signal
import time

import pytest
import rospkg

from node_kit.ros.graph.ros_api import accepts
from tutorial_testing.claims import claim
from tutorial_testing.cockpit.world import World
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import suspended
from tutorial_testing.robot import OBSERVER
from tutorial_testing.socket_page import SocketPage
from tutorial_testing.waiting import tolerance, wait_for

pytestmark = [pytest.mark.xdist_group("cockpit"), pytest.mark.long]
BOUND_S = 0.6  # from the loss to rest
ARM_S = 1.0  # a page waits twice as long for a subscriber that does not connect
TWIST = {"topic": "/cmd_vel", "type": "geometry_msgs/Twist"}
CURVE = {"linear/x": "0.2", "angular/z": "0.5"}
CONFIG = rospkg.RosPack().get_path("fake_turtlebot_sim") + "/config"


class Careless(World):
    """A robot without a timeout, and no other node that drives it."""

    launch = ("fake_turtlebot_sim", "fake_turtlebot.launch", "model:=false")


class WithMaster(Careless):
    """With a separate master, which can end alone: roslaunch would end with its own."""

    def begin(self):
        uri = self.environment["ROS_MASTER_URI"]
        self.master = self.run("rosmaster", "--core", "-p", uri.rpartition(":")[2])
        wait_for(lambda: accepts(uri), "master")
        self.launched = self.run("roslaunch", *self.launch, *self._arguments)
        self.observe(OBSERVER, **self.environment)
        self.start_cockpit()


@pytest.fixture(scope="module")
def world():
    with Careless(f"config:={CONFIG}/rbx1.yaml") as world:
        yield world


@contextlib.contextmanager
def moved(world, period):
    """Yield a page whose form moves the robot."""
    with SocketPage(world.port) as page:

        def hold():
            page.say("publish", **TWIST, values=CURVE, period=period)
            page.signs = (TWIST["topic"],)

        world.drive_by(hold)
        page.wait_for("session", lambda session: session["yours"] and session["topic"])
        yield page


def fall_silent(_world, page):
    page.signs = ()


def stop_elsewhere(world, _page):
    with SocketPage(world.port, Origin=f"http://127.0.0.1:{world.port}") as other:
        who = other.wait_for("drives", lambda drives: "by a form" in drives["who"])["who"]
        assert "drives by a form, on /cmd_vel" in who
        other.say("stop")
        other.wait_for("session", lambda session: session["driver"] is None)


def end(number):
    return lambda world, _: world.cockpit.signal(number)


PAGES = {
    "closed": lambda _, page: page.close(),
    "silent": fall_silent,
    "Stop": lambda _, page: page.say("stop"),
    "Stop elsewhere": stop_elsewhere,
    "Stop publishing": lambda _, page: page.say("publish_end", topic=None),
}
SERVERS = {name: end(signal.Signals[f"SIG{name}"]) for name in ("INT", "TERM", "HUP")}


@claim("A numeric field is ...", because="what arrives, on two topics that nobody had")
def test_expressions_arrive_in_each_message_on_two_new_topics(world):
    point, whole = {"x": "i", "y": "sin(i / 10)", "z": "time()"}, {"data": "i // 2"}
    with SocketPage(world.port) as page, contextlib.ExitStack() as stack:
        page.say("describe", what="types", name="")
        types = page.wait_for("types")["types"]
        for topic, kind, values in (
            ("/wave", "geometry_msgs/Point", point),
            ("/half", "std_msgs/Int32", whole),
        ):
            assert kind in types and "node_kit/Point" not in types
            page.say("publish", topic=topic, type=kind, values=values, period=0.05)
        page.signs = ("/wave", "/half")
        echoes = [stack.enter_context(world.run("rostopic", "echo", "-p", t)) for t in page.signs]
        wait_for(lambda: all(echo.output.count("\n") > 20 for echo in echoes), "20 of both")
        waves, halves = [
            [[float(cell) for cell in line.split(",")] for line in echo.output.splitlines()[1:20]]
            for echo in echoes
        ]
    for at, i, sine, sent in waves:
        assert sine == pytest.approx(math.sin(i / 10)) and abs(at / 1e9 - sent) < 1
    for numbers in ([wave[1] for wave in waves], [half[1] for half in halves]):
        assert numbers == sorted(map(int, numbers)) and len(set(numbers)) >= 9


def judge(world, act, bound_s=BOUND_S):
    late_s, lost_at = tolerance(), time.time()
    act()
    rest_at = world.wait_for_rest(lost_at)
    assert rest_at - lost_at < bound_s + late_s()
    assert world.stays_at_rest()


@claim("What a page publishes ...", because="end to end, a robot without a timeout")
@pytest.mark.parametrize("period", [None, 10.0])
@pytest.mark.parametrize("way", PAGES)
def test_the_end_of_a_form_by_its_page_stops_a_robot_without_a_timeout(world, way, period):
    with moved(world, period) as page:
        judge(world, lambda: PAGES[way](world, page))


@claim(
    "A robot without a timeout that a form moves is stopped when the cockpit ends: Ctrl-C, "
    "SIGTERM, SIGHUP, rosnode kill, a master that has gone"
)
@pytest.mark.parametrize("way", SERVERS)
def test_the_end_of_the_cockpit_stops_a_robot_without_a_timeout(world, way):
    with moved(world, None) as page:
        judge(world, lambda: SERVERS[way](world, page))
    assert world.cockpit.wait() == 0
    world.start_cockpit()


@claim("A robot without ...", because="rosnode kill")
def test_rosnode_kill_stops_a_robot_without_a_timeout(world):
    with moved(world, None), world.run("rosnode", "kill", "/cockpit") as done:
        world.cockpit.wait()
        ended_at = time.time()
        assert world.wait_for_rest() < ended_at + BOUND_S
        assert world.stays_at_rest()
        done.wait()
    world.start_cockpit()


@claim("A robot without ...", because="the master")
def test_without_a_master_or_with_one_that_hangs_a_robot_without_a_timeout_is_stopped():
    """A master that hangs is waited for: the page still drives, and its loss stops the robot."""
    with WithMaster(f"config:={CONFIG}/rbx1.yaml") as world:
        with moved(world, None) as page, suspended([world.master.pid]):
            judge(world, lambda: fall_silent(world, page))
        with moved(world, None):
            judge(world, world.master.kill)


@claim(
    "A cockpit that is killed leaves a TurtleBot to its timeout, and is not shown by the next one, "
    "which arms at once"
)
def test_a_cockpit_that_is_killed_leaves_a_turtlebot_to_its_timeout():
    with World() as world, moved(world, 0.05):
        judge(world, world.cockpit.kill, bound_s=0.7)


@claim("A cockpit that is ...", because="the next cockpit")
def test_a_cockpit_that_was_killed_is_not_shown_by_the_next_one_which_arms_at_once():
    with World() as world:
        with SocketPage(world.port) as page:
            page.sit_down()
            world.cockpit.kill()
        command = node_path("cockpit", "cockpit.py"), "--port", str(world.port), "__name:=another"
        world.cockpit = world.run(*command)
        world.find_page()
        with SocketPage(world.port) as page:
            drives = page.wait_for("drives", lambda drives: not drives["refusal"])
            assert drives["who"] == "Nobody drives."
            late_s, begin_s = tolerance(), time.monotonic()
            page.sit_down()
            assert time.monotonic() - begin_s < ARM_S + late_s()
