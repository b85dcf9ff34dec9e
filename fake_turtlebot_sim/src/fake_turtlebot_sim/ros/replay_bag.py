"""The command replay_bag: its arguments, its picture, and a line for each mistake."""

from __future__ import annotations

import argparse
import os
import sys
import time
from math import isfinite
from pathlib import Path
from typing import Any, Sequence

import yaml
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from fake_turtlebot_sim.errors import ReplayError
from fake_turtlebot_sim.ros.bag_replay import read_commands, replay, topics_of
from fake_turtlebot_sim.simulator.differential_drive import Velocity
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters, parse_parameters
from fake_turtlebot_sim.simulator.simulated_robot import RobotState
from fake_turtlebot_sim.simulator.world import World


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code."""
    parser = argparse.ArgumentParser(
        prog="replay_bag",
        description="Drive a simulated TurtleBot from a bag with geometry_msgs/Twist or"
        " sensor_msgs/Joy, faster than real time, and record what it does.",
    )
    parser.add_argument("bag", type=Path, help="recording of the commands")
    parser.add_argument("output", type=Path, help="new bag with /odom, /tf and /joint_states")
    parser.add_argument("--topic", help="topic of the commands, if there are several")
    parser.add_argument("--config", type=Path, help="YAML file of parameters of fake_turtlebot")
    parser.add_argument("--world", help="world to drive in: room, maze, table or a file")
    parser.add_argument("--picture", type=Path, metavar="PNG", help="draw the path")
    parser.add_argument("--force", action="store_true", help="overwrite the output")
    try:
        run(parser.parse_args(arguments))
    except (ReplayError, ValueError, OSError) as error:
        print(f"replay_bag: {error}", file=sys.stderr)
        return 1
    return 0


def run(options: argparse.Namespace) -> None:
    """Replay as the options say. Raises ReplayError, ValueError or OSError, one line each."""
    parameters = read_parameters(options.config, options.world)
    if options.output.exists() and not options.force:
        raise ReplayError(f"{options.output}: exists already; --force overwrites it")
    if not options.output.parent.is_dir():
        raise ReplayError(f"{options.output.parent}: no such folder")
    topic, kind = choose_topic(options.bag, options.topic)
    began_s = time.monotonic()
    to_velocity = velocity_of_twist if kind is Twist else velocity_of_joy
    commands = read_commands(options.bag, topic, kind, to_velocity)
    # Under another name until it is complete, so that an interruption leaves no partial bag.
    unfinished = options.output.with_name(options.output.name + ".unfinished")
    try:
        unfinished.unlink(missing_ok=True)
        result = replay(commands, unfinished, parameters)
        os.replace(unfinished, options.output)
    finally:
        unfinished.unlink(missing_ok=True)
    took_s = time.monotonic() - began_s
    if options.picture:
        draw(result.path, options.picture, parameters.world)
    end = result.path[-1]
    print(
        f"{options.output}: {result.seconds:.1f} s from {topic} in {took_s:.1f} s,"
        f" {result.distance:.2f} m driven, ends at x {end.x:.3f} m, y {end.y:.3f} m,"
        f" yaw {end.yaw:.3f} rad" + (f"; {result.ignored} ignored" if result.ignored else "")
    )


def read_parameters(path: Path | None, world: str | None = None) -> SimulatorParameters:
    """Return the parameters of a YAML file, or the defaults; world: replaces the file's."""
    in_world = {} if world is None else {"world": world}
    if path is None:
        return parse_parameters(in_world)
    try:
        given = yaml.safe_load(path.read_text(encoding="utf-8")) or {}
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise ReplayError(f"{path}: not YAML ({' '.join(str(error).split())})") from error
    if not isinstance(given, dict):
        raise ReplayError(f"{path}: must hold lines of `name: value`")
    parameters = parse_parameters({**given, **in_world})
    if parameters.robots:
        raise ReplayError(f"{path}: a replay has one robot; leave out ~robots")
    return parameters


def choose_topic(bag: Path, wanted: str | None) -> tuple[str, Any]:
    """Return (topic, message class) of the commands: `wanted`, else a Twist, else a Joy."""
    kinds = {Twist._type: Twist, Joy._type: Joy}
    topics = {
        topic: kinds[kind]
        for topic, kind in sorted(topics_of(bag).items())
        if kind in kinds and wanted in (None, topic)
    }
    topics = {topic: kind for topic, kind in topics.items() if kind is Twist} or topics
    if len(topics) > 1:
        raise ReplayError(f"{bag}: several topics ({', '.join(topics)}); choose one with --topic")
    if not topics:
        name = f"topic {wanted}" if wanted else "topic"
        raise ReplayError(f"{bag}: no {name} of {Twist._type} or {Joy._type}")
    return next(iter(topics.items()))


def velocity_of_twist(twist: Any) -> Velocity:
    """Return (v [m/s], w [rad/s]) of a Twist."""
    return twist.linear.x, twist.angular.z


def velocity_of_joy(joy: Any) -> Velocity:
    """Return (v [m/s], w [rad/s]) of a Joy, as the tutorial's node does; zero if it is unusable."""
    if len(joy.axes) < 2 or not all(map(isfinite, joy.axes[:2])):
        return 0.0, 0.0
    return joy.axes[1], joy.axes[0]


def draw(path: Sequence[RobotState], target: Path, world: World | None = None) -> None:
    """Draw a picture of the path and the world around it."""
    import matplotlib  # noqa: PLC0415  takes a second to load

    matplotlib.use("Agg")
    from matplotlib import pyplot  # noqa: PLC0415
    from matplotlib.collections import LineCollection  # noqa: PLC0415

    figure, axes = pyplot.subplots(figsize=(6, 6))
    if world:
        axes.add_collection(LineCollection(world.walls, colors="black"))
        for x, y, radius in world.posts:
            axes.add_patch(pyplot.Circle((x, y), radius, color="black"))
        for cliff in world.cliffs:
            axes.fill(*zip(*cliff), color="silver")
    axes.plot([state.x for state in path], [state.y for state in path], color="tab:orange")
    axes.plot(path[0].x, path[0].y, "o", color="tab:green", label="start")
    axes.plot(path[-1].x, path[-1].y, "s", color="tab:red", label="end")
    axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    axes.grid(True)
    axes.legend()
    figure.savefig(target, dpi=120)
    pyplot.close(figure)
