"""What is done to a live world for each kind of fault.

Each is a context: its body is the time for which the fault lasts.
"""

import contextlib
import os
import signal
import socket
import subprocess
import time

from node_kit.questions import call
from tutorial_faults.events import Violation
from tutorial_faults.live.kinds import BASE, KINDS
from tutorial_faults.live.talker import PYTHON
from tutorial_faults.live.world import ENDS_S, NAMES

STARTS_S = 0.3  # a node that is started anew does nothing sooner: it is Python, and loads rospy
HOGS = 4  # programs that compute; this is for machines of two cores
MEMORY_BYTES = 400 << 20  # taken, and used, while memory is little
SLOW_S = 0.3  # for one message


@contextlib.contextmanager
def inflict(world, fault):
    """Have a plan.Fault on the world for as long as the body takes."""
    kind = KINDS[fault.kind]
    injury = world.injure(fault.kind)
    with _HOW[kind.family](world, kind, fault):
        yield
        injury.end_s = time.time()
    if kind.family in ("kill", "end"):
        injury.end_s = time.time() + STARTS_S


@contextlib.contextmanager
def _kill(world, kind, _fault):
    world.signal(kind.part, signal.SIGKILL)
    yield
    world.programs[kind.part].wait()
    world.start(kind.part)


@contextlib.contextmanager
def _stop(world, kind, _fault):
    world.signal(kind.part, signal.SIGSTOP)
    try:
        yield
    finally:
        world.signal(kind.part, signal.SIGCONT)


@contextlib.contextmanager
def _end(world, kind, _fault):
    program, asked_s = world.programs[kind.part], time.time()
    world.signal(kind.part, signal.SIGINT)
    yield
    try:
        program.wait(ENDS_S)
    except AssertionError:
        what = f"{kind.part} did not end within {ENDS_S} s of SIGINT"
        world.record.told.append(Violation("g", asked_s, what))
        world.signal(kind.part, signal.SIGKILL)
    world.start(kind.part)


@contextlib.contextmanager
def _unplug(world, _kind, _fault):
    world.hands.plug(False)
    yield
    world.hands.plug(True)


@contextlib.contextmanager
def _frozen_pad(world, _kind, _fault):
    world.hands.freeze(True)
    yield
    world.hands.freeze(False)


@contextlib.contextmanager
def _say(world, kind, fault):
    world.stranger.tell("say", kind.name, fault.lasts_s)
    yield


@contextlib.contextmanager
def _kill_master(world, _kind, _fault):
    world.master.kill()
    yield
    world.master.start(world.simulated)
    world.master.restore()


@contextlib.contextmanager
def _hang_master(world, _kind, _fault):
    world.master.hang()
    yield
    world.master.go_on()


@contextlib.contextmanager
def _stopped_viewer(world, _kind, _fault):
    os.kill(world.viewer.pid, signal.SIGSTOP)
    yield
    os.kill(world.viewer.pid, signal.SIGCONT)


@contextlib.contextmanager
def _slow_viewer(world, _kind, _fault):
    world.viewer.tell("slow", SLOW_S)
    yield
    world.viewer.tell("slow", 0.0)


@contextlib.contextmanager
def _silent_peer(world, _kind, _fault):
    """Connects to the base and to the mux, and says nothing."""
    with contextlib.ExitStack() as stack:
        for node in (NAMES[BASE],):
            uri = world.master.ask("lookupNode", node)
            way = uri and call(uri, "requestTopic", "/odom", [["TCPROS"]])[1]
            if way:
                stack.enter_context(socket.create_connection((way[1], way[2]), 1.0))
        yield


@contextlib.contextmanager
def _programs(*commands):
    running = [
        subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for command in commands
    ]
    try:
        yield
    finally:
        for program in running:
            program.kill()
            program.wait()


def _busy_machine(_world, _kind, _fault):
    return _programs(*[("sh", "-c", "while :; do :; done")] * HOGS)


def _little_memory(_world, _kind, _fault):
    return _programs((PYTHON, "-c", f"import time; b = b'1' * {MEMORY_BYTES}; time.sleep(9)"))


@contextlib.contextmanager
def _full_disk(world, _kind, _fault):
    path = os.path.join(world.hosts.robot_environment["ROS_HOME"], "full")
    with contextlib.suppress(OSError), open(path, "wb") as file:
        while True:
            file.write(bytes(1 << 20))
    try:
        yield
    finally:
        os.unlink(path)


def _link(value):
    """The cable has an ill as long as the fault lasts. value: of it, from the fault's strength."""

    @contextlib.contextmanager
    def ill(world, kind, fault):
        name = "down" if kind.family == "link_down" else kind.family
        world.hosts.ill(name, value(fault.strength))
        try:
            yield
        finally:
            world.hosts.ill(name, 0)

    return ill


def _clock(word, seconds):
    @contextlib.contextmanager
    def step(world, _kind, fault):
        world.clock.tell(word, seconds(fault))
        yield

    return step


_HOW = {
    "kill": _kill,
    "stop": _stop,
    "end": _end,
    "unplug": _unplug,
    "frozen_pad": _frozen_pad,
    "radio_silence": _frozen_pad,
    "second_joystick": _say,
    "nan_joy": _say,
    "broken_joy": _say,
    "nan_command": _say,
    "broken_command": _say,
    "lower_input": _say,
    "kill_master": _kill_master,
    "hang_master": _hang_master,
    "stopped_viewer": _stopped_viewer,
    "slow_viewer": _slow_viewer,
    "silent_peer": _silent_peer,
    "busy_machine": _busy_machine,
    "little_memory": _little_memory,
    "full_disk": _full_disk,
    "link_down": _link(lambda strength: 1),
    "loss": _link(lambda strength: 0.05 + 0.4 * strength),
    "delay": _link(lambda strength: 0.02 + 0.3 * strength),  # [s]
    "duplication": _link(lambda strength: 0.1 + 0.8 * strength),
    "reordering": _link(lambda strength: 0.1 + 0.5 * strength),
    "throttle": _link(lambda strength: 2000 + 20000 * strength),  # [bytes/s]
    "clock_forward": _clock("step", lambda fault: 1 + 9 * fault.strength),
    "clock_back": _clock("step", lambda fault: -1 - 9 * fault.strength),
    "clock_pause": _clock("pause", lambda fault: fault.lasts_s),
}
