"""./tutorial faults --fuzz: random Joy messages and random device bytes to the live nodes."""

import contextlib
import os
import select
import sys
import tempfile
import time
from random import Random

from tutorial_faults.live import hosts
from tutorial_faults.live.judge import Record, judge
from tutorial_faults.live.kinds import NODES
from tutorial_faults.live.random_bytes import events
from tutorial_faults.live.samples import MOST_GROWTH_KB, sample
from tutorial_faults.live.talker import Talker
from tutorial_faults.live.world import World
from tutorial_testing.waiting import wait_for

CHUNK = 64  # events
WARMS_UP = 0.1  # part of all, after which nothing may grow
STALLED_S = 120.0  # without a byte being taken


class Fuzz:
    """What came of it."""

    def __init__(self, world):
        """world: live."""
        self._world, self.bad, self.sent, self.done = world, [], 0, False
        self._before, self._pids = {}, {node: world.programs[node].pid for node in NODES}

    def hear(self, line):
        """Take a line of fuzzer."""
        word, _, rest = line.strip().partition(" ")
        if word == "sent":
            self.sent = int(rest)
        elif word == "bad":
            self.bad.append(rest)
        else:
            self.done = True

    def measure(self):
        """Keep how much memory each node has, before."""
        self._before = self._memory()

    def _memory(self):
        samples = [sample(0.0, node, self._world.programs[node].pid) for node in NODES]
        return {one.node: one.memory_kb for one in samples if one}

    def complaints(self):
        """Lines about what is wrong: velocities, exceptions, nodes that ended or grew."""
        lines, now = list(dict.fromkeys(self.bad))[:20], self._memory()
        for node in NODES:
            program = self._world.programs[node]
            if program.ended:
                lines.append(f"{node} has ended")
            if "Traceback" in program.output:
                lines.append(f"{node} printed a traceback: {program.output[-1500:]}")
            grown = now.get(node, 0) - self._before.get(node, now.get(node, 0))
            print(f"{node}: {now.get(node)} kB, grew by {grown} kB")
            if grown > MOST_GROWTH_KB:
                lines.append(f"{node} grew by {grown} kB")
        lines += [f"({v.invariant}) {v.what}" for v in judge(self._only_limits()).violations]
        return lines

    def _only_limits(self):
        """What wheels and commands did; whose hands it was nobody can tell."""
        record = self._world.record
        return Record(commands=record.commands, asked=record.asked)


def fuzz_joys(world, the_fuzz, count, seed):
    """Send so many random Joy messages to joy2twist."""
    prefix, given = world.hosts.workstation_prefix, world.hosts.workstation_environment
    environment = {**os.environ, **given}
    with Talker(
        "fuzzer", seed, count, prefix=prefix, environment=environment, hear=the_fuzz.hear
    ) as fuzzer:
        fuzzer.wait_ready()
        warm = False
        while not the_fuzz.done and not fuzzer.ended:
            if not warm and the_fuzz.sent >= WARMS_UP * count:
                warm = True
                the_fuzz.measure()
            time.sleep(1.0)
            world.begin_record()  # nobody looks at a long one
    return the_fuzz.sent


def fuzz_device(world, the_fuzz, count, seed):
    """Write so many random bytes to the gamepad's FIFO; how many the driver has taken."""
    random, written, opened, warm = Random(seed), 0, 1, False
    world.hands.freeze(True)
    fd = _open(world.hands.path)
    try:
        while written < count:
            _, writable, _ = select.select((), [fd], (), STALLED_S)
            if not writable:
                the_fuzz.bad.append(f"the driver takes no bytes after {written}")
                break
            try:
                written += os.write(fd, events(random, CHUNK))
            except BlockingIOError:
                continue
            except BrokenPipeError:  # to the driver all of it was noise for so long
                os.close(fd)
                fd = _open(world.hands.path)
                opened += 1
            if not warm and written >= WARMS_UP * count:
                warm = True
                the_fuzz.measure()
    finally:
        os.close(fd)
        world.hands.freeze(False)
    print(f"the driver opened its device {opened} times")
    return written


def _open(path):
    """A FIFO, for writing, as soon as the driver reads it."""

    def try_it():
        with contextlib.suppress(OSError):
            return os.open(path, os.O_WRONLY | os.O_NONBLOCK)

    return wait_for(try_it, "driver that opens its device", STALLED_S)


def fuzz(count, seed):
    """Send so many messages and so many bytes; the exit code."""
    with contextlib.ExitStack() as stack:
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        home = os.path.join(folder, "home")
        os.mkdir(home)
        the_hosts = stack.enter_context(hosts.Hosts(home, seed))
        os.environ.update(the_hosts.robot_environment)
        world = stack.enter_context(World(the_hosts, folder))
        world.drive()
        lines = []
        for what, work in (("device bytes", fuzz_device), ("Joy messages", fuzz_joys)):
            the_fuzz = Fuzz(world)
            the_fuzz.measure()
            began = time.monotonic()
            done = work(world, the_fuzz, count, seed)
            print(f"{done} random {what} in {time.monotonic() - began:.0f} s", flush=True)
            lines += the_fuzz.complaints()
        try:
            world.drive()  # and it still does
        except AssertionError as error:
            words = world.last_words().items()
            lines += [f"(h) {error}", *(f"{node} said: {said}" for node, said in words if said)]
    print("\n".join(lines or ["no exception, no growth, no velocity that must not be"]))
    sys.stdout.flush()
    return int(bool(lines))
