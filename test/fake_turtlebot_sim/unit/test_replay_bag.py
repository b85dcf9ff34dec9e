"""Bags in, bags out: the command replay_bag."""

import contextlib
from math import inf, pi
from pathlib import Path

import pytest
import rosbag
from genpy import Duration, Time
from geometry_msgs.msg import Twist
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from sensor_msgs.msg import Joy

from cockpit_server.ros.tabs import bag_files
from fake_turtlebot_sim.ros import replay_bag as replay_command
from gamepad.ros.bags import check_recording
from tutorial_testing.claims import claim
from tutorial_testing.hostile import end_of
from tutorial_testing.processes import REPOSITORY
from tutorial_tools.ros import rqt_bag

pytestmark = claim(
    "replay_bag drives as the simulator, the same to the byte; a mistake or a damaged bag is one "
    "line"
)
START = Time(1_400_000_000)
PRESET = REPOSITORY / "joy2twist" / "config" / "f710_d.yaml"


def twist(v, w):
    message = Twist()
    message.linear.x, message.angular.z = v, w
    return message


# A quarter circle of radius 0.2 m in a second: the last command ends by the timeout.
QUARTER = [(ms, twist(0.1 * pi, 0.5 * pi)) for ms in (0, 200, 400)]
JOYS = [(200 * k, Joy(axes=[0.0, 0.7], buttons=[0] * 12)) for k in range(35)]


def write_bag(path, topic_messages, *options):
    """Write {topic: [(ms after the start, message)]}; options: of rosbag.Bag."""
    with rosbag.Bag(str(path), "w", *options) as bag:
        for topic, messages in topic_messages.items():
            for time_ms, message in messages:
                bag.write(topic, message, START + Duration.from_sec(time_ms / 1000))


def read_bag(path):
    """Return {topic: [message]}, each stamped with the time of its record."""
    read = {}
    with rosbag.Bag(str(path)) as bag:
        for topic, message, time in bag.read_messages():
            header = getattr(message, "header", None) or message.transforms[0].header
            assert header.stamp == time
            read.setdefault(topic, []).append(message)
    return read


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Run the command in a folder with commands.bag; its /cmd_vel takes precedence over /joy."""
    monkeypatch.chdir(tmp_path)
    write_bag("commands.bag", {"/joy": JOYS, "/cmd_vel": QUARTER})
    return lambda words: replay_command.main(words.split())


def test_the_robot_obeys_the_bag_until_the_timeout(run, capsys):
    assert run("commands.bag out.bag") == 0
    read = read_bag("out.bag")
    assert {topic: len(messages) for topic, messages in read.items()} == dict.fromkeys(
        ("/odom", "/tf", "/joint_states"), 51
    )
    stamps = [odometry.header.stamp for odometry in read["/odom"]]
    assert stamps == [START + Duration(0, k * 20_000_000) for k in range(51)]
    end = read["/odom"][-1]
    assert (end.pose.pose.position.x, end.pose.pose.position.y) == pytest.approx((0.2, 0.2))
    assert end.twist.twist.linear.x == 0.0
    assert "1.0 s from /cmd_vel" in capsys.readouterr().out


def test_the_output_is_the_same_to_the_byte(run):
    Path("noisy").write_text("{wheel_noise: 0.01, seed: 3}")
    assert run("commands.bag a.bag --config noisy") == run("commands.bag b.bag --config noisy") == 0
    assert Path("a.bag").read_bytes() == Path("b.bag").read_bytes()


def test_a_joystick_in_a_room_drives_to_the_wall(run):
    assert run("commands.bag out.bag --topic /joy --world room --picture path.png") == 0
    assert Path("path.png").stat().st_size > 10_000
    read = read_bag("out.bag")
    truth = read["/base_pose_ground_truth"][-1].pose.pose.position
    assert (truth.x, truth.y) == pytest.approx((4.0 - 0.178, 0.0), abs=1e-9)
    frames = {(t.header.frame_id, t.child_frame_id) for t in read["/tf"][0].transforms}
    assert frames == {("odom", "base_footprint"), ("map", "odom")}


@pytest.mark.parametrize(("words", "said"), [
    ("none.bag out.bag", "no such file"),
    (". out.bag", "a folder, not a file"),
    ("commands.bag out.bag --topic /other", "no topic /other of"),
    ("two.bag out.bag", "(/a, /b); choose one with --topic"),
    ("cut.bag out.bag", "not a complete ROS 1 bag"),
    ("late.bag out.bag", "is silent for 1.0 h: damaged"),
    ("commands.bag none/out.bag", "no such folder"),
    ("commands.bag precious.bag", "--force overwrites it"),
    ("commands.bag out.bag --config robots:3", "one robot"),
    ("commands.bag out.bag --config [", "not YAML"),
    ("commands.bag out.bag --config 5", "name: value"),
])  # fmt: skip
def test_a_mistake_is_one_line_and_leaves_nothing_behind(run, capsys, words, said):
    write_bag("two.bag", {"/a": QUARTER, "/b": QUARTER})
    write_bag("late.bag", {"/cmd_vel": [*QUARTER, (3_600_000, twist(0, 0))]})
    Path("cut.bag").write_bytes(Path("commands.bag").read_bytes()[:-500])
    Path("precious.bag").write_text("precious")
    for config in ("robots:3", "[", "5"):
        Path(config).write_text(config.replace(":", ": "))
    assert run(words) == 1
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("replay_bag: ") and len(err.splitlines()) == 1
    assert said in err
    assert Path("precious.bag").read_text() == "precious"
    assert not list(Path().glob("*out.bag*"))


@pytest.mark.parametrize(
    ("axes", "velocity"), [([0.3, 0.5, 1.0], (0.5, 0.3)), ([0.3], (0, 0)), ([0.3, inf], (0, 0))]
)
def test_a_joystick_drives_as_the_tutorials_node_does(axes, velocity):
    assert replay_command.velocity_of_joy(Joy(axes=axes)) == velocity


def read_everywhere(bag):
    """Read a bag like the launch file's guard, rqt_bag, the cockpit's page and replay_bag."""
    for read in (
        lambda: check_recording(str(bag), str(PRESET)), lambda: rqt_bag.read(bag),
        lambda: bag_files.read(bag),
    ):  # fmt: skip
        with contextlib.suppress(ValueError):
            read()
    return replay_command.main([str(bag), str(bag.with_name("out.bag")), "--force"])


DAMAGES = st.tuples(  # place; inserted bytes; how many bytes they replace, or all that follow
    st.floats(0, 1),
    st.binary(max_size=12) | st.sampled_from([b"\0" * 4, b"\xff" * 8, b"\xff\xff\xff\x7f"]),
    st.sampled_from([0, 4, 8, 40, 4000, 10**9]),
)


@settings(max_examples=8, deadline=None, database=None, suppress_health_check=[*HealthCheck])
@given(DAMAGES, st.sampled_from(["none", "bz2", "lz4"]))
def test_a_damaged_bag_ends_in_one_line_wherever_it_is_read(bags, damage, kind):
    (where, new, lost), bag = damage, bags / "damaged.bag"
    data = (bags / f"{kind}.bag").read_bytes()
    at = int(where * len(data))
    bag.write_bytes(data[:at] + new + data[at + lost :])
    end_of(lambda: read_everywhere(bag))


@pytest.fixture(scope="module")
def bags(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bags")
    for kind in ("none", "bz2", "lz4"):
        write_bag(folder / f"{kind}.bag", {"/cmd_vel": QUARTER, "/joy": JOYS[:3]}, kind, 300)
    return folder
