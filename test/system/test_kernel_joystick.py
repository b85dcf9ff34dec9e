"""A joystick of a real Linux kernel drives the robot, with launch_joy_node.launch.

What is driven is in kernel/drive.py. Here, if this kernel makes joysticks; else in QEMU with
Debian's kernel: see kernel/machine.py.
"""

import os
import platform
import re
from pathlib import Path

import pytest

from tutorial_testing.kernel import machine
from tutorial_testing.kernel.machine import (
    EXIT,
    MachineError,
    NoKernelError,
    command_of_machine,
    kernel,
    make_initramfs,
    makes_joysticks,
)
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

DRIVE = Path(machine.__file__).with_name("drive.py")
SILENT_S = 900.0  # without a new line of the program, which takes some minutes
NOT_HERE = "no /dev/uinput and joydev here, and no machine in the machine"
ROS_ENVIRONMENT = ("PATH", "PYTHONPATH", "CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PKG_CONFIG_PATH")


def environment_of_guest():
    names = [name for name in os.environ if name in ROS_ENVIRONMENT or name.startswith("ROS_")]
    given = {name: os.environ[name] for name in names if name not in ("ROS_IP", "ROS_LOG_DIR")}
    # A folder of the guest's own: QEMU, which another user than root runs, may not read root's.
    given.update(HOME="/run", ROS_HOSTNAME="localhost", PYTHONUNBUFFERED="1")
    given["ROS_MASTER_URI"] = "http://localhost:11311"
    return [f"{name}={value}" for name, value in given.items()]


def start(command, here, tmp_path):
    """Return (where it runs, the program)."""
    if here:
        return f"here, Linux {platform.release()}", Program(*command)
    try:
        image, tree = kernel()
    except NoKernelError as error:
        pytest.skip(f"{NOT_HERE}: {error}")
    except MachineError as error:
        pytest.fail(f"{NOT_HERE}: {error}")
    command = ["/usr/bin/env", "-i", *environment_of_guest(), *command]
    make_initramfs(tmp_path / "initramfs", tree, command)
    where = f"in QEMU, {image.name.replace('vmlinuz-', 'Linux ')}"
    return where, Program(*command_of_machine(image, tmp_path / "initramfs"))


def wait_while_it_prints(program):
    """Wait for the end of a Program; return its exit code. AssertionError if it is silent."""
    while not program.ended:
        said = len(program.output)
        wait_for(
            lambda: program.ended or len(program.output) > said,  # noqa: B023  called at once
            f"further line, after:\n{program.output}",
            SILENT_S,
        )
    return program.wait()


@pytest.mark.usefixtures("master_uri")
def test_a_joystick_of_the_kernel_drives_the_robot(tmp_path, capsys):
    here = makes_joysticks()
    where, program = start(["/usr/bin/python3", str(DRIVE)], here, tmp_path)
    with program:
        try:
            status = wait_while_it_prints(program)
        finally:
            output = program.output
            said = re.findall(r"^drive: .*?(?=\r?$)", output, re.MULTILINE)
            with capsys.disabled():
                print(f"\nkernel joystick, {where}:", *said, sep="\n  ")
            print(output)  # which pytest shows if this fails
    if not here:  # the exit code was that of QEMU
        ended = re.search(f"{EXIT} (\\d+)", output)
        status = int(ended[1]) if ended else None
    assert status == 0
    assert said[-1] == "drive: passed"
