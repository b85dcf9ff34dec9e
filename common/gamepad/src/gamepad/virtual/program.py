"""A virtual Logitech F710, moved by keys, a script of moves or a recording.

Made by the kernel (/dev/uinput), or with --stream served through a FIFO that joy_node opens as its
device. Needs no ROS, but for --bag.
"""

import argparse
import contextlib
import math
import os
import select
import signal
import sys
import time

import yaml

from gamepad.gamepads import F710
from gamepad.virtual.controls import Controls, positions
from gamepad.virtual.keyboard import HELP, Keyboard
from gamepad.virtual.moves import load_script
from gamepad.virtual.pads import UINPUT, PadError, StreamPad, UinputPad
from gamepad.virtual.sources import (
    KeySource,
    UntouchedSource,
    recording_source,
    script_source,
)
from gamepad.virtual.terminal import REFRESH_S, Terminal

NAME = "virtual_joystick"


def parse(arguments):
    """Return the command line; roslaunch's name:=value are left out."""
    parser = argparse.ArgumentParser(prog=NAME, description="A virtual Logitech F710 gamepad.")
    parser.add_argument("--mode", choices=sorted(F710), help="the switch of the gamepad")
    parser.add_argument("--stream", metavar="PATH", help=f"serve a FIFO instead of {UINPUT}")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--script", metavar="FILE", help="follow a YAML file of timed moves")
    what.add_argument("--bag", metavar="FILE", help="follow the recorded /joy of a bag")
    parser.add_argument("--topic", default="/joy", help="topic in the bag (/joy)")
    parser.add_argument("--loop", action="store_true", help="begin again at the end")
    return parser.parse_args([word for word in arguments if ":=" not in word])


def read_script(path):
    """Return the moves.Script in a YAML file. Raises ValueError, OSError."""
    with open(path, encoding="utf-8") as file:
        try:
            return load_script(yaml.safe_load(file))
        except yaml.YAMLError as error:
            raise ValueError(" ".join(str(error).split())) from None


def read_bag(path, topic):
    """[(time [s], (axes, buttons))] of a topic of a bag. Raises ValueError, OSError."""
    import rosbag  # noqa: PLC0415  nothing else needs ROS

    try:
        with rosbag.Bag(path) as bag:
            return [
                (stamp.to_sec(), (message.axes, message.buttons))
                for _, message, stamp in bag.read_messages(topics=[topic])
            ]
    except rosbag.ROSBagException as error:
        raise ValueError(str(error)) from None
    except AttributeError:
        raise ValueError(f"{topic} is no sensor_msgs/Joy") from None


def make_source(options):
    """(gamepad, source, keyboard or None). Raises ValueError, OSError."""
    if options.script:
        script = read_script(options.script)
        gamepad = F710[options.mode or script.mode]
        return gamepad, script_source(gamepad, script, options.loop), None
    gamepad = F710[options.mode or "D"]
    if options.bag:
        recorded = read_bag(options.bag, options.topic)
        return gamepad, recording_source(gamepad, recorded, options.loop), None
    if not sys.stdin.isatty():
        return gamepad, UntouchedSource(gamepad), None
    keyboard = Keyboard()
    return gamepad, KeySource(gamepad, keyboard), keyboard


def play(pad, source, keyboard, terminal):
    """Move the gamepad as the source says until its end. keyboard, terminal: both, or None."""
    while True:
        step = source.at(time.monotonic())
        if step is None:
            return
        position, until = step
        pad.show(position)
        if terminal:
            if not terminal.show(source.controls):
                keyboard.release()
                pad.show(source.at(time.monotonic())[0])
            until = min(until, time.monotonic() + REFRESH_S)
        if wait(pad, terminal, until):
            text = terminal.read()
            keyboard.press(text, time.monotonic())
            keyboard.quit = keyboard.quit or not text


def wait_for_reader(pad, gamepad):
    """Wait until a program reads: a script must not begin before."""
    pad.show(positions(gamepad, Controls()))
    while not pad.connected:
        wait(pad, None, math.inf)
        pad.show(positions(gamepad, Controls()))


def wait(pad, terminal, until):
    """Wait for a key, for a time [s], or for the gamepad's reader; returns whether a key came."""
    poll = select.poll()
    if terminal:
        poll.register(terminal, select.POLLIN)
    timeout = min(until - time.monotonic(), pad.watch(poll))
    ready = poll.poll(None if math.isinf(timeout) else max(0.0, timeout * 1000))
    return terminal is not None and terminal.fileno() in [fd for fd, _ in ready]


def run(options):
    """Make the gamepad and move it."""
    gamepad, source, keyboard = make_source(options)
    pad = StreamPad(gamepad, options.stream) if options.stream else UinputPad(gamepad)
    with contextlib.ExitStack() as stack:
        stack.enter_context(pad)
        where = f"through the FIFO {options.stream}" if options.stream else "as a kernel device"
        print(f"{NAME}: {gamepad.name} ({gamepad.usb_id}), {where}", flush=True)
        terminal = None
        if keyboard:
            print(HELP, end="", flush=True)
            terminal = stack.enter_context(Terminal())
        elif isinstance(source, UntouchedSource):
            print(f"{NAME}: no terminal to read keys from; nobody moves the gamepad", flush=True)
        if not keyboard:
            wait_for_reader(pad, gamepad)
        play(pad, source, keyboard, terminal)


def main():
    """Run until the end, Q or a signal; exit code 1 and one line if it cannot start."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: sys.exit(0))  # through all __exit__, unlike a signal
    options = parse(sys.argv[1:])
    try:
        run(options)
    except PadError as error:
        sys.exit(f"{NAME}: {error}")
    except OSError as error:
        sys.exit(f"{NAME}: cannot read {error.filename}: {os.strerror(error.errno or 0)}")
    except ValueError as error:
        sys.exit(f"{NAME}: {options.script or options.bag}: {error}")
