"""A virtual Logitech F710, moved by keys, a script of moves or a recording.

The kernel creates it (/dev/uinput), or with --stream a FIFO serves it, which joy_node opens as its
device. Only --bag needs ROS.
"""

from __future__ import annotations

import argparse
import math
import os
import select
import signal
import sys
import time
from typing import Sequence

import yaml

from gamepad.errors import PadError
from gamepad.gamepads import F710, Gamepad
from gamepad.io.pads import UINPUT, StreamPad, UinputPad
from gamepad.io.terminal import REFRESH_S, KeyTerminal
from gamepad.virtual.controls import Controls, Position, positions
from gamepad.virtual.keyboard import HELP, Keyboard
from gamepad.virtual.moves import MoveScript, load_script
from gamepad.virtual.sources import KeySource, TimedSource, recording_source, script_source

NAME = "virtual_joystick"


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    """Return the parsed command line, without roslaunch's name:=value."""
    parser = argparse.ArgumentParser(prog=NAME, description="A virtual Logitech F710 gamepad.")
    parser.add_argument("--mode", choices=sorted(F710), help="the switch of the gamepad")
    parser.add_argument("--stream", metavar="PATH", help=f"serve a FIFO instead of {UINPUT}")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--script", metavar="FILE", help="follow a YAML file of timed moves")
    what.add_argument("--bag", metavar="FILE", help="follow the recorded /joy of a bag")
    parser.add_argument("--topic", default="/joy", help="topic in the bag (/joy)")
    parser.add_argument("--loop", action="store_true", help="restart at the end")
    return parser.parse_args([word for word in arguments if ":=" not in word])


def read_script(path: str) -> MoveScript:
    """Return the moves in a YAML file. Raises ValueError or OSError."""
    with open(path, encoding="utf-8") as file:
        try:
            return load_script(yaml.safe_load(file))
        except yaml.YAMLError as error:
            raise ValueError(" ".join(str(error).split())) from None


def read_bag(path: str, topic: str) -> list[tuple[float, Position]]:
    """Return (time [s], position) of a topic in a bag. Raises ValueError or OSError."""
    from gamepad.errors import BagError  # noqa: PLC0415
    from gamepad.ros.bags import opened  # noqa: PLC0415  only this needs ROS

    with opened(path) as bag:
        recorded = list(bag.read_messages(topics=[topic]))
        if not all(hasattr(message, "axes") for _, message, _ in recorded):
            raise BagError(f"{path}: {topic} is no sensor_msgs/Joy")
        return [(stamp.to_sec(), (joy.axes, joy.buttons)) for _, joy, stamp in recorded]


def make_source(options: argparse.Namespace) -> tuple[Gamepad, KeySource | TimedSource]:
    """Return the gamepad and its source. Raises ValueError or OSError."""
    if options.script:
        script = read_script(options.script)
        gamepad = F710[options.mode or script.mode]
        return gamepad, script_source(gamepad, script, options.loop)
    gamepad = F710[options.mode or "D"]
    if options.bag:
        recorded = read_bag(options.bag, options.topic)
        return gamepad, recording_source(gamepad, recorded, options.loop)
    return gamepad, KeySource(gamepad, Keyboard())


def follow_keys(pad: StreamPad | UinputPad, source: KeySource, terminal: KeyTerminal) -> None:
    """Move the gamepad by the keys of a terminal until the user quits."""
    keyboard = source.keyboard
    while step := source.at(time.monotonic()):
        position, until = step
        pad.show(position)
        if not terminal.show(source.controls):
            keyboard.release()
            position, _ = source.at(time.monotonic()) or step
            pad.show(position)
        if wait(pad, terminal, min(until, time.monotonic() + REFRESH_S)):
            text = terminal.read()
            keyboard.press(text, time.monotonic())
            keyboard.quit = keyboard.quit or not text


def wait(pad: StreamPad | UinputPad, terminal: KeyTerminal | None, until: float) -> bool:
    """Wait for a key, a time [s] or the gamepad's reader; return whether a key was pressed."""
    poll = select.poll()
    if terminal:
        poll.register(terminal, select.POLLIN)
    timeout = min(until - time.monotonic(), pad.watch(poll))
    ready = poll.poll(max(0.0, timeout * 1000))
    return terminal is not None and terminal.fileno() in [fd for fd, _ in ready]


def run(options: argparse.Namespace) -> None:
    """Create the gamepad and move it."""
    gamepad, source = make_source(options)
    pad = StreamPad(gamepad, options.stream) if options.stream else UinputPad(gamepad)
    with pad:
        where = f"through the FIFO {options.stream}" if options.stream else "as a kernel device"
        print(f"{NAME}: {gamepad.name} ({gamepad.usb_id}), {where}", flush=True)
        if isinstance(source, KeySource) and sys.stdin.isatty():
            print(HELP, end="", flush=True)
            with KeyTerminal() as terminal:
                follow_keys(pad, source, terminal)
            return
        if isinstance(source, KeySource):
            print(f"{NAME}: no terminal to read keys from; the gamepad stays released", flush=True)
        pad.show(positions(gamepad, Controls()))
        while not pad.connected:  # a script must not start before a program reads
            wait(pad, None, math.inf)
            pad.show(positions(gamepad, Controls()))
        while step := source.at(time.monotonic()):
            position, until = step
            pad.show(position)
            wait(pad, None, until)


def main() -> None:
    """Run until the end, Q or a signal; exit code 1 and one line if it cannot start."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: sys.exit(0))  # runs all __exit__ methods, unlike a signal
    options = parse(sys.argv[1:])
    try:
        run(options)
    except PadError as error:
        sys.exit(f"{NAME}: {error}")
    except OSError as error:
        sys.exit(f"{NAME}: cannot read {error.filename}: {os.strerror(error.errno or 0)}")
    except ValueError as error:
        path, why = options.script or options.bag, str(error)  # a BagError begins with the path
        sys.exit(f"{NAME}: {why if why.startswith(path) else f'{path}: {why}'}")
