"""The firmware's side of a Kobuki's serial line, on a pseudo terminal, as simple as possible.

It obeys base controls at once, and counts ticks and turns. Tests switch it off, restart it and
unplug its cable.
"""

import contextlib
import os
import threading
import time
import tty
from dataclasses import replace
from math import pi

from kobuki_protocol import commands, robot_packets
from kobuki_protocol.base_control import velocity_of
from kobuki_protocol.feedback import Core, Feedback, Inertia, RawGyro
from kobuki_protocol.framing import Framer
from kobuki_protocol.identity import Controller, FirmwareVersion, HardwareVersion, UniqueId

PERIOD_S = 0.02
TICKS_PER_M = 11724.4
GYRO = RawGyro(0, ((0, 0, 100), (0, 0, 200)))


class KobukiOnALine:
    """A Kobuki at the path of a symbolic link; a context manager that ends it."""

    def __init__(self, link, firmware=FirmwareVersion(0, 2, 1)):  # noqa: B008
        self.link, self.firmware = link, firmware
        self.core = {}  # what its sensors report: fields of Core
        self.noise = b""  # sent before each packet
        self.is_on = True
        self.received = []  # (time [s], command)
        self._master = self._slave = None
        self._lock, self._ended = threading.Lock(), threading.Event()
        self.restart()

    def restart(self):
        """Count from zero, as after being switched on."""
        self._started_s = time.monotonic()
        self.ticks, self.heading, self.velocity = [0.0, 0.0], 0.0, (0.0, 0.0)

    def plug(self):
        """Plug the cable in; the port gets a new name each time."""
        master, slave = os.openpty()
        tty.setraw(slave)
        os.set_blocking(master, False)
        with self._lock:
            self._master, self._slave = master, slave
        with contextlib.suppress(FileNotFoundError):
            os.unlink(self.link)
        os.symlink(os.ttyname(slave), self.link)

    def unplug(self):
        """Unplug the cable."""
        os.unlink(self.link)
        with self._lock:
            os.close(self._master)
            os.close(self._slave)
            self._master = None

    def __enter__(self):
        threading.Thread(target=self._run, daemon=True).start()
        return self

    def __exit__(self, *_):
        self._ended.set()
        with contextlib.suppress(OSError):
            self.unplug()

    @property
    def controls(self):
        """The base controls so far, as (time [s], control)."""
        return [pair for pair in self.received if isinstance(pair[1], commands.BaseControl)]

    @property
    def moves(self):
        return self.velocity != (0.0, 0.0)

    def _run(self):
        framer, next_s = Framer(), time.monotonic()
        while not self._ended.wait(max(0.0, next_s - time.monotonic())):
            next_s += PERIOD_S
            self._move()
            with self._lock, contextlib.suppress(OSError):
                if self._master is None:
                    framer = Framer()
                    continue
                data = b""
                with contextlib.suppress(BlockingIOError):
                    data = os.read(self._master, 4096)
                answers = self._obey(framer.feed(data)) if self.is_on else []
                if self.is_on:
                    packet = robot_packets.build(*self._feedback().parts(), *answers)
                    os.write(self._master, self.noise + packet)

    def _move(self):
        v, w = self.velocity if self.is_on else (0.0, 0.0)
        for side, sign in ((0, -1), (1, 1)):
            self.ticks[side] += (v + sign * 0.115 * w) * PERIOD_S * TICKS_PER_M
        self.heading = (self.heading + w * PERIOD_S + pi) % (2 * pi) - pi

    def _feedback(self):
        stamp = int(1000 * (time.monotonic() - self._started_s)) % 65536
        left, right = (int(ticks // 1) % 65536 for ticks in self.ticks)
        core = Core(stamp, left_encoder=left, right_encoder=right, battery=164)
        inertia = Inertia.of(self.heading, self.velocity[1])
        return Feedback(core=replace(core, **self.core), inertia=inertia, gyro=GYRO)

    def _obey(self, payloads):
        answers = []
        for payload in payloads:
            for command in commands.parse(payload):
                self.received.append((time.monotonic(), command))
                if isinstance(command, commands.BaseControl):
                    self.velocity = velocity_of(command)
                elif isinstance(command, commands.IdentityRequest):
                    answers += [HardwareVersion(4, 0, 1), self.firmware, UniqueId((1, 2, 3))]
                elif isinstance(command, commands.GetController):
                    answers.append(Controller())
        return answers
