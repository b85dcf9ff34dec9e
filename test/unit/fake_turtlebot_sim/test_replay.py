"""Bags in, bags out: the library bag_replay and the command around it."""

import contextlib
from io import BytesIO
from math import hypot, inf, pi
from pathlib import Path

import pytest
import rosbag
from genpy import Time
from geometry_msgs.msg import Twist
from hypothesis import given
from hypothesis import strategies as st
from nav_msgs.msg import Odometry
from rosbags.rosbag1 import Reader, Writer
from sensor_msgs.msg import JointState, Joy
from tf2_msgs.msg import TFMessage

from cockpit_server.sources import recording
from fake_turtlebot_sim.replay import bag_replay
from fake_turtlebot_sim.replay import command as replay_command
from fake_turtlebot_sim.simulator.parameters import Parameters
from gamepad.dead_man import check_recording
from tutorial_testing.hostile import damaged, end_of, many
from tutorial_tools import bag as rqt_bag

START_NS = 1_400_000_000 * 10**9
PRESET = Path(__file__).parents[3] / "joy2twist" / "config" / "f710_d.yaml"
JOY_BAG = Path(__file__).parents[3] / "joy2twist" / "bag" / "joy.bag"


def twist(v, w):
    message = Twist()
    message.linear.x, message.angular.z = v, w
    return message


# A quarter circle of radius 0.2 m in half a second, then a stop.
QUARTER = [(0, twist(0.1 * pi, 0.5 * pi)), (500, twist(0.1 * pi, 0.5 * pi)), (1000, twist(0, 0))]


def write_bag(path, topic_messages):
    """Write {topic: [(ms after the start, message)]}."""
    with Writer(path) as writer:
        for topic, messages in topic_messages.items():
            kind = type(messages[0][1])
            connection = writer.add_connection(
                topic,
                kind._type.replace("/", "/msg/"),
                msgdef=kind._full_text,
                md5sum=kind._md5sum,
            )
            for time_ms, message in messages:
                buffer = BytesIO()
                message.serialize(buffer)
                writer.write(connection, START_NS + time_ms * 10**6, buffer.getvalue())
    return path


def read_bag(path):
    """Return {topic: [message]}."""
    kinds = {kind._type: kind for kind in (Odometry, TFMessage, JointState)}
    read = {}
    with Reader(path) as reader:
        for connection, time_ns, data in reader.messages():
            message = kinds[connection.msgtype.replace("/msg/", "/")]().deserialize(data)
            header = getattr(message, "header", None) or message.transforms[0].header
            assert header.stamp.to_nsec() == time_ns
            read.setdefault(connection.topic, []).append(message)
    return read


@pytest.fixture
def commands(tmp_path):
    return write_bag(tmp_path / "commands.bag", {"/cmd_vel": QUARTER})


def test_the_robot_obeys_the_bag(commands, tmp_path, capsys):
    target = tmp_path / "out.bag"
    assert replay_command.main([str(commands), str(target)]) == 0
    read = read_bag(target)
    assert set(read) == {"/odom", "/tf", "/joint_states"}
    assert len(read["/odom"]) == len(read["/tf"]) == len(read["/joint_states"]) == 51
    stamps = [odometry.header.stamp.to_nsec() for odometry in read["/odom"]]
    assert stamps == [START_NS + k * 20_000_000 for k in range(51)]
    end = read["/odom"][-1].pose.pose
    assert (end.position.x, end.position.y) == pytest.approx((0.2, 0.2), abs=1e-9)
    transform = read["/tf"][-1].transforms[0].transform
    assert (transform.translation.x, transform.rotation) == (end.position.x, end.orientation)
    assert "1.0 s from /cmd_vel" in capsys.readouterr().out


def test_the_output_is_the_same_to_the_byte(commands, tmp_path):
    noisy = tmp_path / "noisy.yaml"
    noisy.write_text("{wheel_noise: 0.01, seed: 3}")
    outputs = [tmp_path / "a.bag", tmp_path / "b.bag"]
    for output in outputs:
        arguments = [str(commands), str(output), "--config", str(noisy)]
        assert replay_command.main(arguments) == 0
    assert outputs[0].read_bytes() == outputs[1].read_bytes()


def test_after_the_last_command_the_timeout_stops_the_robot(tmp_path):
    bag = write_bag(tmp_path / "once.bag", {"/cmd_vel": [(0, twist(0.7, 0.0))]})
    recorded = bag_replay.read_commands(bag, "/cmd_vel", Twist, replay_command.velocity_of_twist)
    result = bag_replay.replay(recorded, tmp_path / "out.bag", Parameters())
    assert result.path[-1].x == pytest.approx(0.42, abs=1e-9)
    assert result.path[-1].v == 0.0
    assert result.seconds == pytest.approx(0.6)


def test_the_recorded_joystick_of_the_tutorial_comes_home(tmp_path, capsys):
    target = tmp_path / "tour.bag"
    assert replay_command.main([str(JOY_BAG), str(target)]) == 0
    end = read_bag(target)["/odom"][-1].pose.pose.position
    assert (end.x, end.y) == pytest.approx((0, 0), abs=1e-3)
    assert "from /joy" in capsys.readouterr().out


def test_a_velocity_goes_before_a_joystick_and_the_user_may_choose(tmp_path):
    joy = Joy(axes=[0.0] * 6, buttons=[0] * 12)
    bag = write_bag(tmp_path / "both.bag", {"/joy": [(0, joy)], "/cmd_vel": QUARTER})
    assert replay_command.choose_topic(bag, None) == ("/cmd_vel", Twist)
    assert replay_command.choose_topic(bag, "/joy") == ("/joy", Joy)


def failure_of(capsys, *arguments):
    assert replay_command.main([str(argument) for argument in arguments]) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("replay_bag: ")
    assert len(err.splitlines()) == 1
    return err


def test_mistakes_are_one_clear_line_and_leave_nothing_behind(commands, tmp_path, capsys):
    out = tmp_path / "out.bag"
    assert "no such file" in failure_of(capsys, tmp_path / "none.bag", out)
    assert "--topic" not in failure_of(capsys, commands, out, "--topic", "/other")
    two = write_bag(tmp_path / "two.bag", {"/a": QUARTER, "/b": QUARTER})
    assert "(/a, /b); choose one with --topic" in failure_of(capsys, two, out)
    text = tmp_path / "text.bag"
    text.write_text("no bag at all")
    assert "not a whole ROS 1 bag" in failure_of(capsys, text, out)
    cut = tmp_path / "cut.bag"
    cut.write_bytes(JOY_BAG.read_bytes()[:50_000])
    assert "not a whole ROS 1 bag" in failure_of(capsys, cut, out)
    late = write_bag(tmp_path / "late.bag", {"/cmd_vel": [*QUARTER, (3_600_000, twist(0, 0))]})
    assert "is silent for 1.0 h: damaged" in failure_of(capsys, late, out)
    config = tmp_path / "config.yaml"
    for content, part in [
        ("rat: 1", "did you mean ~rate?"),
        ("robots: 3", "one robot"),
        ("[", "not YAML"),
        ("5", "name: value"),
    ]:
        config.write_text(content)
        assert part in failure_of(capsys, commands, out, "--config", config)
    assert "no such folder" in failure_of(capsys, commands, tmp_path / "none" / "out.bag")
    assert not out.exists()
    assert not list(tmp_path.glob("*.unfinished"))
    out.write_text("precious")
    assert "--force overwrites it" in failure_of(capsys, commands, out)
    assert out.read_text() == "precious"


@pytest.mark.parametrize(
    ("axes", "velocity"),
    [([0.3, 0.5, 1.0], (0.5, 0.3)), ([0.3], (0.0, 0.0)), ([0.3, inf], (0.0, 0.0))],
)
def test_a_joystick_drives_as_the_tutorials_node_does(axes, velocity):
    assert replay_command.velocity_of_joy(Joy(axes=axes)) == velocity


def test_a_recording_in_a_room_meets_its_column_and_a_wall(tmp_path, capsys):
    output, picture = tmp_path / "out.bag", tmp_path / "path.png"
    arguments = [str(JOY_BAG), str(output), "--world", "room", "--picture", str(picture)]
    assert replay_command.main(arguments) == 0
    assert picture.stat().st_size > 10_000
    read = read_bag(output)
    places = [message.pose.pose.position for message in read["/base_pose_ground_truth"]]
    nearest = min(hypot(place.x - 2.4, place.y - 1.3) for place in places)
    assert nearest == pytest.approx(0.25 + 0.178, abs=1e-9)  # the column's radius and the robot's
    assert min(place.y for place in places) == pytest.approx(-2.5 + 0.178, abs=1e-9)
    frames = {(t.header.frame_id, t.child_frame_id) for t in read["/tf"][0].transforms}
    assert frames == {("odom", "base_footprint"), ("map", "odom")}
    assert replay_command.main([*arguments, "--force", "--world", "moon"]) == 1
    assert "no world of this package" in capsys.readouterr().err


def guard(bag):
    """Do as the launch file's guard, the command rqt_bag and the cockpit's page with a bag."""
    for read in (
        lambda: check_recording(str(bag), str(PRESET)), lambda: rqt_bag.read(bag),
        lambda: recording.read(bag),
    ):  # fmt: skip
        with contextlib.suppress(ValueError):
            read()
    return 0


@many(15)
@given(st.data(), st.sampled_from(["joy", "none", "bz2", "lz4"]))
def test_a_damaged_bag_ends_in_one_line_wherever_it_is_read(bags, data, kind):
    bag, out = bags / "damaged.bag", bags / "out.bag"
    bag.write_bytes(data.draw(damaged((bags / f"{kind}.bag").read_bytes())))
    end_of(lambda: replay_command.main([str(bag), str(out), "--force"]))
    end_of(lambda: guard(bag))


@pytest.fixture(scope="module")
def bags(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bags")
    (folder / "joy.bag").write_bytes(JOY_BAG.read_bytes())
    for kind in ("none", "bz2", "lz4"):
        with rosbag.Bag(str(folder / f"{kind}.bag"), "w", kind, chunk_threshold=300) as bag:
            for time_ms, message in QUARTER:
                bag.write("/cmd_vel", message, Time(START_NS // 10**9, time_ms * 10**6))
                bag.write("/joy", Joy(axes=[0.5] * 6, buttons=[0] * 12), Time(START_NS // 10**9))
    return folder
