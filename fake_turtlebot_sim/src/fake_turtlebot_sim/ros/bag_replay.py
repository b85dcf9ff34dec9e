"""Replay of a bag of commands: writes a bag of the robot that obeys them, without a master.

The simulation is that of the node, but time comes from the bag, so it runs as fast as the machine
can. rosbags (PyPI) reads and writes the bags; the messages are ROS's own classes.
"""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from math import hypot
from pathlib import Path
from typing import Any, Callable, Iterator, List, Optional, Tuple

from genpy import Time
from rosbags.rosbag1 import Reader, Writer
from tf2_msgs.msg import TFMessage

from fake_turtlebot_sim.errors import ReplayError
from fake_turtlebot_sim.simulator.differential_drive import Velocity
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.robot_messages import RobotMessages
from fake_turtlebot_sim.simulator.simulated_robot import RobotState, SimulatedRobot

LONGEST_SILENCE_S = 1000.0  # between two commands
Commands = List[Tuple[int, Optional[Velocity]]]  # times [ns]; None: a message to ignore


@dataclass
class Replay:
    """The result of a replay."""

    seconds: float  # simulated time
    distance: float  # [m] along the path
    path: list[RobotState]  # for each period: the odometry, or in a world the true state
    ignored: int  # messages without a command


def read_commands(
    path: Path, topic: str, kind: Any, to_velocity: Callable[[Any], Velocity | None]
) -> Commands:
    """Return the commands in the messages of class `kind` on a topic of a bag.

    to_velocity converts a message into (v [m/s], w [rad/s]) or None. Raises ReplayError.
    """
    message = kind()
    with _open(path) as reader:
        connections = [c for c in reader.connections if c.topic == topic]
        commands = [
            (time_ns, to_velocity(message.deserialize(data)))
            for _, time_ns, data in reader.messages(connections)
        ]
    if not commands:
        raise ReplayError(f"{path}: no message on {topic}")
    for (before_ns, _), (after_ns, _) in zip(commands, commands[1:]):
        if after_ns - before_ns > LONGEST_SILENCE_S * 1e9:
            hours = (after_ns - before_ns) / 3.6e12
            why = f"is silent for {hours:.1f} h: damaged, or more than a single drive"
            raise ReplayError(f"{path}: {topic} {why}")
    return commands


def topics_of(path: Path) -> dict[str, str]:
    """Return {topic: message type, such as geometry_msgs/Twist} of a bag. Raises ReplayError."""
    with _open(path) as reader:
        return {c.topic: c.msgtype.replace("/msg/", "/") for c in reader.connections}


@contextmanager
def _open(path: Path) -> Iterator[Reader]:
    if not path.is_file():
        raise ReplayError(f"{path}: {'a folder, not a file' if path.is_dir() else 'no such file'}")
    try:
        with Reader(path) as reader:
            yield reader
    except Exception as error:  # rosbags raises KeyError and more for a damaged file
        why = " ".join(str(error).split()) or type(error).__name__
        raise ReplayError(f"{path}: not a complete ROS 1 bag ({why:.200})") from None


def replay(commands: Commands, target: Path, parameters: SimulatorParameters) -> Replay:
    """Obey the commands and write odom, /tf and joint_states to a new bag `target`.

    The bag begins at the first command and ends when the robot has stopped after the last one.
    """
    robot = SimulatedRobot(parameters, parameters.start_poses()[""])
    messages, path = RobotMessages(parameters), []
    with Writer(target) as writer:
        topics = {
            "/odom": messages.odometry,
            "/tf": TFMessage([messages.transform] + [messages.in_map] * bool(parameters.world)),
            "/joint_states": messages.joints,
        }
        if robot.odometry_differs:
            topics["/base_pose_ground_truth"] = messages.ground_truth
        connections = [(_add(writer, topic, message), message) for topic, message in topics.items()]
        for now_ns in periods(robot, commands, parameters.period_ns()):
            messages.fill(robot, Time(*divmod(now_ns, 10**9)))
            for connection, message in connections:
                buffer = BytesIO()
                message.serialize(buffer)
                writer.write(connection, now_ns, buffer.getvalue())
            path.append(robot.true_state() if parameters.world else robot.state())
    return Replay(
        seconds=(now_ns - commands[0][0]) * 1e-9,
        distance=sum(hypot(b.x - a.x, b.y - a.y) for a, b in zip(path, path[1:])),
        path=path,
        ignored=sum(velocity is None for _, velocity in commands),
    )


def _add(writer: Writer, topic: str, message: Any) -> Any:
    kind = message._type.replace("/", "/msg/")  # the name in rosbags
    return writer.add_connection(topic, kind, msgdef=message._full_text, md5sum=message._md5sum)


def periods(robot: SimulatedRobot, commands: Commands, period_ns: int) -> Iterator[int]:
    """Move the robot period by period through the commands; yield the time [ns] of each period."""
    start_ns = now_ns = commands[0][0]
    waiting = list(reversed(commands))
    while waiting or robot.is_moving:
        while waiting and waiting[-1][0] <= now_ns:
            time_ns, velocity = waiting.pop()
            if velocity is not None:
                robot.command(velocity, time_ns - start_ns)
        robot.advance(now_ns - start_ns)
        yield now_ns
        now_ns += period_ns
