"""A joystick of a real Linux kernel drives: here, or in QEMU where this kernel makes none."""

import os
import re
import shlex
import shutil
from pathlib import Path

import pytest

from tutorial_testing.kernel import machine
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program

LONGEST_S = 3600.0  # alone some minutes; beside other tests several times as long
UDEVD = "/lib/systemd/systemd-udevd"
# What the guest's environment has of this one's.
KEPT = r"PATH|PYTHONPATH|CMAKE_PREFIX_PATH|LD_LIBRARY_PATH|PKG_CONFIG_PATH|ROS_(?!IP|LOG_DIR).*"


def makes_joysticks():
    """Return whether this kernel does, and has none that would be taken for the virtual one."""
    there = map(os.path.exists, ("/sys/module/joydev", "/run/udev/control"))
    return os.access("/dev/uinput", os.W_OK) and all(there) and not Path("/dev/input/js0").exists()


def in_guest(command, folder, shift):
    """Return the command of a machine in which a command runs."""
    given = {name: value for name, value in os.environ.items() if re.fullmatch(KEPT, name)}
    # A folder of the guest's own: QEMU, which another user than root runs, may not read root's.
    given.update(HOME="/run", ROS_HOSTNAME="localhost", PYTHONUNBUFFERED="1")
    given["ROS_MASTER_URI"] = "http://localhost:11311"
    script = f"{UDEVD} --daemon; env -i {shlex.join(map('='.join, given.items()))} {command}"
    return machine.command_of_machine(folder / "initramfs", script, shift)


# The page has a processor twice as fast: 0.2 s after a beat the cockpit calls a page late.
@pytest.mark.parametrize(("script", "shift"), [("drive", 1), ("drive_page", 0)])
def test_a_joystick_of_the_kernel_drives_the_robot_by(script, shift, tmp_path):
    needed = ("chromium", "chromedriver") if "page" in script else ()
    for program in (*needed, *(() if makes_joysticks() else machine.NEEDED)):
        if not shutil.which(program):
            pytest.skip(f"no {program}: ./tutorial setup or ./tutorial test browser installs it")
    command = f"/usr/bin/python3 -m tutorial_testing.kernel.{script}"
    command = command.split() if makes_joysticks() else in_guest(command, tmp_path, shift)
    with Program(*command, ROS_MASTER_URI=f"http://localhost:{free_port()}") as program:
        try:
            program.wait(LONGEST_S)
        finally:
            print(program.output)  # which pytest shows if this fails
        assert "drive: passed" in program.output
