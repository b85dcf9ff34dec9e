"""The command replay_bag: arguments, progress, picture and one clear line for each mistake."""

import argparse
import os
import sys
import time
from math import isfinite
from pathlib import Path

import yaml
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from fake_turtlebot_sim.simulator.parameters import parse_parameters

try:
    from tqdm import tqdm

    from fake_turtlebot_sim.replay import bag_replay
except ImportError as error:  # neither is needed to run the robot live
    bag_replay, missing = None, error


class CommandError(Exception):
    """What the user can mend; the text says how, in one line."""


def main(arguments=None):
    """Run the command and return its exit code."""
    options = parse(arguments)
    try:
        if bag_replay is None:
            raise CommandError(f"needs {missing.name}: ./tutorial setup")
        try:
            run(options)
        except bag_replay.ReplayError as error:
            raise CommandError(error) from error
    except (CommandError, ValueError, OSError) as error:
        print(f"replay_bag: {error}", file=sys.stderr)
        return 1
    return 0


def parse(arguments):
    """Return the options, or end with argparse's own line about them."""
    parser = argparse.ArgumentParser(
        prog="replay_bag",
        description="Drive a simulated TurtleBot from a bag with geometry_msgs/Twist or"
        " sensor_msgs/Joy, faster than real time, and record what it does.",
    )
    parser.add_argument("bag", type=Path, help="recording of the commands")
    parser.add_argument("output", type=Path, help="new bag with /odom, /tf and /joint_states")
    parser.add_argument("--topic", help="which topic holds the commands, if there are several")
    parser.add_argument("--config", type=Path, help="YAML file of parameters of fake_turtlebot")
    parser.add_argument("--picture", type=Path, metavar="PNG", help="draw the path")
    parser.add_argument("--force", action="store_true", help="overwrite the output")
    return parser.parse_args(arguments)


def run(options):
    """Replay as the options say; raises one of the errors that main() tells."""
    parameters = read_parameters(options.config)
    if options.output.exists() and not options.force:
        raise CommandError(f"{options.output}: exists already; --force overwrites it")
    if not options.output.parent.is_dir():
        raise CommandError(f"{options.output.parent}: no such folder")
    topic, kind = choose_topic(options.bag, options.topic)
    to_velocity = velocity_of_twist if kind is Twist else velocity_of_joy
    began_s = time.monotonic()
    commands = bag_replay.read_commands(options.bag, topic, kind, to_velocity)
    # Under another name until it is whole, so that an interruption leaves no half of a bag.
    unfinished = options.output.with_name(options.output.name + ".unfinished")
    try:
        unfinished.unlink(missing_ok=True)
        result = replay_with_progress(commands, unfinished, parameters)
        os.replace(unfinished, options.output)
    finally:
        unfinished.unlink(missing_ok=True)
    took_s = time.monotonic() - began_s
    if options.picture:
        draw(result.path, options.picture)
    end = result.path[-1]
    print(
        f"{options.output}: {result.seconds:.1f} s from {topic} in {took_s:.1f} s,"
        f" {result.distance:.2f} m driven, ends at x {end.x:.3f} m, y {end.y:.3f} m,"
        f" yaw {end.yaw:.3f} rad" + (f"; {result.ignored} ignored" if result.ignored else "")
    )


def replay_with_progress(commands, target, parameters):
    """Call bag_replay.replay() behind a bar that counts simulated seconds."""
    total_s = round((commands[-1][0] - commands[0][0]) * 1e-9)
    with tqdm(total=total_s, unit="s", unit_scale=True, disable=None) as bar:

        def progress(seconds):
            if int(seconds) > bar.n:
                bar.update(int(seconds) - bar.n)

        return bag_replay.replay(commands, target, parameters, progress)


def read_parameters(path):
    """Return the Parameters of a YAML file, or the defaults without one."""
    if path is None:
        return parse_parameters({})
    try:
        given = yaml.safe_load(path.read_text(encoding="utf-8")) or {}
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise CommandError(f"{path}: not YAML ({' '.join(str(error).split())})") from error
    if not isinstance(given, dict):
        raise CommandError(f"{path}: must hold lines of `name: value`")
    parameters = parse_parameters(given)
    if parameters.robots:
        raise CommandError(f"{path}: a replay is of one robot; leave ~robots out")
    return parameters


def choose_topic(bag, wanted):
    """Return (topic, message class) of the commands: the wanted, a Twist, or a Joy."""
    kinds = {Twist._type: Twist, Joy._type: Joy}
    found = {t: kinds[kind] for t, kind in bag_replay.topics_of(bag).items() if kind in kinds}
    if wanted is not None:
        found = {topic: kind for topic, kind in found.items() if topic == wanted}
    twists = {topic: kind for topic, kind in found.items() if kind is Twist}
    candidates = sorted((twists or found).items(), key=lambda candidate: candidate[0])
    if len(candidates) != 1:
        topics = ", ".join(topic for topic, _ in candidates)
        if topics:
            raise CommandError(f"{bag}: several topics ({topics}); choose one with --topic")
        name = f"topic {wanted}" if wanted else "topic"
        raise CommandError(f"{bag}: no {name} of {Twist._type} or {Joy._type}")
    return candidates[0]


def velocity_of_twist(twist):
    """Return (v [m/s], w [rad/s]) of a Twist."""
    return twist.linear.x, twist.angular.z


def velocity_of_joy(joy):
    """Return (v [m/s], w [rad/s]) as the tutorial's node makes it of a Joy.

    A message that cannot be used stops the robot, as it does there.
    """
    if len(joy.axes) < 2 or not all(map(isfinite, joy.axes[:2])):
        return 0.0, 0.0
    return joy.axes[1], joy.axes[0]


def draw(path, target):
    """Draw the path of RobotStates as a picture."""
    try:
        import matplotlib  # noqa: PLC0415
    except ImportError as error:
        raise CommandError("--picture needs matplotlib: ./tutorial setup") from error
    matplotlib.use("Agg")
    from matplotlib import pyplot  # noqa: PLC0415

    figure, axes = pyplot.subplots(figsize=(6, 6))
    axes.plot([state.x for state in path], [state.y for state in path], color="tab:orange")
    axes.plot(path[0].x, path[0].y, "o", color="tab:green", label="start")
    axes.plot(path[-1].x, path[-1].y, "s", color="tab:red", label="end")
    axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    axes.grid(True)
    axes.legend()
    figure.savefig(target, dpi=120)
    pyplot.close(figure)
