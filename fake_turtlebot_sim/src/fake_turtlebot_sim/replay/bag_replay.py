"""From a recording of commands to a recording of the robot that obeys them, without a master.

The same simulation as in the node, only that time is read from the bag, and so as fast as the
machine can. rosbags (PyPI) reads and writes the bags; the messages are ROS's own classes.
"""

from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from math import hypot
from pathlib import Path

from genpy import Time
from genpy.message import DeserializationError
from rosbags.rosbag1 import Reader, ReaderError, Writer
from tf2_msgs.msg import TFMessage

from fake_turtlebot_sim.simulator.ros_messages import RobotMessages
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot


class ReplayError(Exception):
    """A bag that cannot be replayed; the text says which and why, in one line."""


@dataclass
class Replay:
    """What came of it."""

    seconds: float  # of simulated time
    periods: int
    distance: float  # [m] along the path of the odometry
    path: list  # of RobotState, one for each period
    ignored: int  # commands that were none


def read_commands(path, topic, message_class, to_velocity):
    """Return [(time [ns], velocity or None)] of the messages on a topic of a bag, in their order.

    to_velocity turns a message into (v [m/s], w [rad/s]), or None if it is not to be obeyed.
    Raises ReplayError.
    """
    commands, message = [], message_class()
    with _open(path) as reader:
        connections = [c for c in reader.connections if c.topic == topic]
        for _, time_ns, data in reader.messages(connections):
            commands.append((time_ns, to_velocity(message.deserialize(data))))
    if not commands:
        raise ReplayError(f"{path}: no message on {topic}")
    return commands


def topics_of(path):
    """Return {topic: message type, such as geometry_msgs/Twist} of a bag. Raises ReplayError."""
    with _open(path) as reader:
        return {c.topic: c.msgtype.replace("/msg/", "/") for c in reader.connections}


@contextmanager
def _open(path):
    if not Path(path).is_file():
        raise ReplayError(f"{path}: no such file")
    try:
        with Reader(path) as reader:
            yield reader
    except (ReaderError, DeserializationError, OSError, EOFError) as error:
        raise ReplayError(f"{path}: not a whole ROS 1 bag ({error})") from error


def replay(commands, target, parameters, progress=lambda seconds: None):
    """Obey the commands and write odom, /tf and joint_states to a new bag `target`.

    progress is called with the simulated time [s] of each period. Returns a Replay.
    The robot starts at the first command and is watched until it has come to rest after the last.
    """
    robot = SimulatedRobot(parameters.robot_model(""), parameters.start_poses()[""])
    messages, path = RobotMessages(parameters), []
    with Writer(target) as writer:
        record = Recorder(writer, messages, robot.has_errors)
        start_ns = commands[0][0]
        for now_ns in periods(robot, commands, parameters):
            messages.tell(robot, Time(*divmod(now_ns, 10**9)))
            record(now_ns)
            path.append(robot.state())
            progress((now_ns - start_ns) * 1e-9)
    return Replay(
        seconds=(now_ns - start_ns) * 1e-9,
        periods=len(path),
        distance=sum(hypot(b.x - a.x, b.y - a.y) for a, b in zip(path, path[1:])),
        path=path,
        ignored=sum(velocity is None for _, velocity in commands),
    )


def periods(robot, commands, parameters):
    """Move the robot period by period through the commands; yield the time [ns] of each."""
    start_ns = commands[0][0]
    waiting = iter(commands)
    time_ns, velocity = next(waiting)
    now_ns = start_ns
    while time_ns is not None or robot.is_moving:
        while time_ns is not None and time_ns <= now_ns:
            if velocity is not None:
                robot.command(velocity, time_ns - start_ns)
            time_ns, velocity = next(waiting, (None, None))
        robot.advance(now_ns - start_ns)
        yield now_ns
        now_ns += parameters.period_ns()


class Recorder:
    """Writes the messages of one robot into a bag."""

    def __init__(self, writer, messages, has_truth):
        """Take a rosbags Writer and the RobotMessages that will be told anew for each record."""
        self._writer = writer
        self._buffer = BytesIO()
        self._topics = [
            self._add("odom", messages.odometry),
            self._add("/tf", TFMessage([messages.transform])),
            self._add("joint_states", messages.joints),
        ]
        if has_truth:
            self._topics.append(self._add("base_pose_ground_truth", messages.ground_truth))

    def _add(self, topic, message):
        connection = self._writer.add_connection(
            "/" + topic.lstrip("/"),
            message._type.replace("/", "/msg/"),  # as rosbags names it
            msgdef=message._full_text,
            md5sum=message._md5sum,
        )
        return connection, message

    def __call__(self, time_ns):
        """Write what the messages tell now."""
        for connection, message in self._topics:
            self._buffer.seek(0)
            self._buffer.truncate()
            message.serialize(self._buffer)
            self._writer.write(connection, time_ns, self._buffer.getvalue())
