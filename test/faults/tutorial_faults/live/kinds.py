"""The kinds of faults: what each does to a live world, and what is promised under it."""

import contextlib
import os
import signal
import time
from dataclasses import dataclass
from functools import partial
from typing import Any, Callable, Collection, Dict, List, Tuple

from tutorial_testing.processes import Program

DRIVER, JOY2TWIST, MUX, BASE = "joy_node", "joy2twist", "mux", "base"
NODES = (DRIVER, JOY2TWIST, MUX, BASE)
SAFETY = "safety_controller"  # in a world; itself it is not hit

LINK, MOUNT = "network namespaces", "mounting"  # what a kind needs of the machine

# After a longer silence the mux lets no command through that comes together with others (its
# SILENCE_S): so late may a packet arrive that TCP sends once more, and still count.
RESENT_S = 0.5
VIGILANCE_S = 1.0  # joy2twist's ~vigilance_timeout here, for more trials
STARTS_S = 0.3  # a node that is restarted does nothing sooner: it loads rospy
HOGS = 4  # programs that compute; this is for machines of two cores


@dataclass(frozen=True)
class Kind:
    """A kind of fault."""

    name: str
    lasts_s: Tuple[float, float]  # the shortest and the longest time
    # Called with (world, Kind, plan.Fault): a context manager, in whose body the fault lasts.
    inflict: Callable[..., Any]
    loses: bool = False  # a part is lost meanwhile, so the wheels must be at rest in time
    goes_on: bool = False  # the robot must be driven on all the while
    late_s: float = 0.0  # what it may add to the time until the wheels are at rest
    rearms: bool = True  # a robot that stood must wait for the release
    needs: str = ""  # LINK, MOUNT

    @property
    def family(self) -> str:
        """The kind without the part that it hits."""
        return self.name.split(":")[0]

    @property
    def part(self) -> str:
        """The part that it hits, or ""."""
        return self.name.partition(":")[2]

    @property
    def restarts(self) -> bool:
        """Whether a node is restarted at the end."""
        return self.family in ("kill", "end")


@contextlib.contextmanager
def inflicted(world, fault):
    """Have a plan.Fault on the world, and in its record, for as long as the body takes."""
    kind = KINDS[fault.kind]
    injury = world.injure(fault.kind)
    with kind.inflict(world, kind, fault):
        yield
        injury.end_s = time.time()
    if kind.restarts:
        injury.end_s = time.time() + STARTS_S


@contextlib.contextmanager
def _between(do, begin, end):
    do(begin)
    try:
        yield
    finally:
        do(end)


def _ended_by(number):
    """Return what ends a node by a signal and restarts it."""

    @contextlib.contextmanager
    def inflict(world, kind, _fault):
        asked_s = time.time()
        world.signal(kind.part, number)
        yield
        world.await_end(kind.part, asked_s)
        world.start(kind.part)

    return inflict


def _suspended(send_of):
    """Return what stops a process and lets it go on. send_of: what signals it, from a world."""
    return lambda world, kind, _: _between(send_of(world, kind), signal.SIGSTOP, signal.SIGCONT)


def _said(world, kind, fault):
    world.stranger.write(kind.name, fault.lasts_s)
    return contextlib.nullcontext()


def _killed_master(world, _kind, _fault):
    os.kill(world.master.pid, signal.SIGKILL)
    world.is_used_up = True  # no node registers itself with a new master
    return contextlib.nullcontext()


@contextlib.contextmanager
def _busy(_world, _kind, _fault):
    with contextlib.ExitStack() as stack:
        for _ in range(HOGS):
            stack.enter_context(Program("sh", "-c", "while :; do :; done"))
        yield


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


def _ill(least, more):
    """Return what makes the cable ill. least, more: value at strength 0, and added at 1."""
    return lambda world, kind, fault: _between(
        partial(world.hosts.ill, kind.name), least + more * fault.strength, 0
    )


def _kinds():
    stopped = _suspended(lambda world, kind: partial(world.signal, kind.part))
    for node in NODES:
        yield Kind(f"kill:{node}", (0.05, 0.7), _ended_by(signal.SIGKILL), loses=True)
        yield Kind(f"stop:{node}", (0.02, 1.5), stopped, loses=True)
        yield Kind(f"end:{node}", (0.05, 0.7), _ended_by(signal.SIGINT), loses=True)
    unplugged = lambda world, *_: _between(world.hands.plug, False, True)  # noqa: E731
    frozen = lambda world, *_: _between(world.hands.freeze, True, False)  # noqa: E731
    yield Kind("unplug", (0.02, 1.2), unplugged, loses=True)
    yield Kind("frozen_pad", (0.7, 1.5), frozen, loses=True)
    # Out of reach: the receiver keeps the last state, and only joy2twist can notice.
    yield Kind("radio_silence", (0.1, 2.5), frozen, loses=True, late_s=VIGILANCE_S)
    yield Kind("second_joystick", (0.1, 1.0), _said)
    # A bad message stops until the next good one, as joy2twist's README has it: no loss.
    yield Kind("odd_joy", (0.1, 1.0), _said, rearms=False)
    yield Kind("broken_joy", (0.1, 1.0), _said, rearms=False)
    yield Kind("kill_master", (0.1, 1.0), _killed_master, goes_on=True)
    hung = _suspended(lambda world, _: partial(os.kill, world.master.pid))
    yield Kind("hang_master", (0.1, 1.5), hung, goes_on=True)
    for topic in ("teleop", "navi", "cmd_vel"):
        yield Kind(f"nan_command:{topic}", (0.1, 1.0), _said, goes_on=True)
        yield Kind(f"broken_command:{topic}", (0.1, 1.0), _said, goes_on=True)
    yield Kind("lower_input", (0.1, 1.0), _said, goes_on=True)
    viewer = _suspended(lambda world, _: partial(os.kill, world.viewer.pid))
    yield Kind("stopped_viewer", (0.1, 1.5), viewer, goes_on=True)
    yield Kind("busy_machine", (0.3, 1.5), _busy)
    yield Kind("full_disk", (0.3, 1.5), _full_disk, goes_on=True, needs=MOUNT)
    yield Kind("link_down", (0.05, 1.5), _ill(1, 0), loses=True, needs=LINK)
    yield Kind("loss", (0.3, 1.5), _ill(0.05, 0.4), late_s=RESENT_S, needs=LINK)
    yield Kind("delay", (0.3, 1.5), _ill(0.02, 0.3), late_s=RESENT_S, needs=LINK)  # [s]
    yield Kind("duplication", (0.3, 1.5), _ill(0.1, 0.8), needs=LINK)
    yield Kind("reordering", (0.3, 1.5), _ill(0.1, 0.5), late_s=RESENT_S, needs=LINK)
    # [bytes/s]
    yield Kind("throttle", (0.3, 1.5), _ill(2000, 20000), late_s=RESENT_S, needs=LINK)


KINDS: Dict[str, Kind] = {kind.name: kind for kind in _kinds()}


def chosen(words: Collection[str], granted: Collection[str]) -> List[str]:
    """Return the names of the kinds of a command line; all of them if there are no words.

    words: names of kinds, or of families such as kill. granted: those of LINK and MOUNT that there
    are.
    """
    return [
        kind.name
        for kind in KINDS.values()
        if (not words or kind.name in words or kind.family in words)
        and (not kind.needs or kind.needs in granted)
    ]
