"""joy_node and launch_joy_node.launch with a joystick of a real Linux kernel: see kernel/drive.py.

Here, if this kernel can make joysticks; else in QEMU with Debian's kernel: see kernel/machine.py.
"""

import os
import platform
import re
import sys
from pathlib import Path

import pytest
from processes import Program

KERNEL = Path(__file__).with_name("kernel")
sys.path.insert(0, str(KERNEL))
from machine import (  # noqa: E402  the folder of this test
    EXIT,
    MachineError,
    command_of_machine,
    kernel,
    make_initramfs,
)

DEADLINE_S = 300.0
ROS_ENVIRONMENT = ("PATH", "PYTHONPATH", "CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PKG_CONFIG_PATH")


def has_joysticks():
    """Whether this kernel makes joysticks for this user."""
    return os.access("/dev/uinput", os.W_OK) and Path("/sys/module/joydev").exists()


def environment_of_guest():
    names = [name for name in os.environ if name in ROS_ENVIRONMENT or name.startswith("ROS_")]
    names = [name for name in names if name not in ("ROS_IP", "ROS_LOG_DIR")]
    given = {name: os.environ[name] for name in names}
    given.update(HOME="/root", ROS_HOSTNAME="localhost", PYTHONUNBUFFERED="1")
    given["ROS_MASTER_URI"] = "http://localhost:11311"
    return [f"{name}={value}" for name, value in given.items()]


def drive_here(tmp_path):
    return Program("/usr/bin/python3", str(KERNEL / "drive.py"))


def drive_in_guest(tmp_path):
    try:
        image, tree = kernel()
    except MachineError as error:
        pytest.skip(f"no /dev/uinput and joydev here, and no machine in the machine: {error}")
    command = ["/usr/bin/env", "-i", *environment_of_guest()]
    command += ["/usr/bin/python3", str(KERNEL / "drive.py")]
    make_initramfs(tmp_path / "initramfs", tree, command)
    return Program(*command_of_machine(image, tmp_path / "initramfs"))


@pytest.mark.usefixtures("master_uri")
def test_a_joystick_of_the_kernel_drives_the_robot(tmp_path, capsys):
    here = has_joysticks()
    with (drive_here if here else drive_in_guest)(tmp_path) as program:
        status = program.wait(DEADLINE_S)
        output = program.output
    with capsys.disabled():
        where = f"here, Linux {platform.release()}" if here else "in QEMU"
        told = re.findall(r"^drive: .*", output, re.MULTILINE)
        print(f"\nkernel joystick, {where}:", *told, sep="\n  ")
    assert status == 0, output
    if not here:
        ended = re.search(f"{EXIT} (\\d+)", output)
        assert ended and ended[1] == "0", output
    assert told and told[-1].startswith("drive: passed"), output
