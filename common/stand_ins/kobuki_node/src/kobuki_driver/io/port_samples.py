"""Samples from the ports that may lead to a Kobuki, for the doctor."""

from __future__ import annotations

import os
import time
from pathlib import Path

from kobuki_driver.choice import USUAL_PORT, VARIABLE
from kobuki_driver.errors import PortError
from kobuki_driver.io.ports import latency_timer_ms, ports
from kobuki_driver.io.serial_port import SerialPort
from kobuki_driver.link.sample import Sample, Sampler
from kobuki_driver.link.udev_rules import FOLDER, NAME
from kobuki_protocol import commands

LISTEN_S = 1.0
CONVERTERS = "/dev/ttyUSB"


def samples() -> list[Sample]:
    """Return a Sample of each port that the variable names or that has a Kobuki's converter."""
    named = os.environ.get(VARIABLE, USUAL_PORT)
    paths = [named] if named != USUAL_PORT or os.path.exists(USUAL_PORT) else []
    paths += [port.path for port in ports() if port.is_kobuki]
    # A port with several paths counts once; the named path comes first.
    by_device = {os.path.realpath(path): path for path in reversed(paths)}
    return [sample(path) for path in by_device.values()]


def sample(path: str) -> Sample:
    """Listen at a port for a second and return the Sample; ask a robot for its version."""
    is_usb = os.path.realpath(path).startswith(CONVERTERS)  # not a pseudo terminal
    has_rule = not is_usb or Path(FOLDER, NAME).exists()
    sampler = Sampler()
    try:
        port = SerialPort(path)
    except PortError as error:
        return Sample(path, str(error), has_rule)
    try:
        end = time.monotonic() + LISTEN_S
        while time.monotonic() < end:
            sampler.take(port.read())
            if sampler.packets and not sampler.firmware:
                port.write(commands.build(commands.IdentityRequest()))
    except PortError as error:
        return Sample(path, str(error), has_rule)
    finally:
        port.close()
    return Sample(
        path,
        has_rule=has_rule,
        latency_ms=latency_timer_ms(path),
        count=sampler.count,
        packets=sampler.packets,
        damaged=sampler.damaged,
        firmware=sampler.firmware,
        battery=sampler.battery,
    )
