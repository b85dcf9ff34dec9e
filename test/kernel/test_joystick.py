"""A joystick of a real Linux kernel: with launch_joy_node.launch, and with the cockpit's page.

What is driven is in kernel/drive.py and kernel/drive_page.py. Here, if this kernel makes joysticks;
else in QEMU with Debian's kernel: see kernel/machine.py.
"""

import os
import platform
import re
import shlex
import shutil
from importlib.util import find_spec
from pathlib import Path

import pytest

from tutorial_testing.kernel import machine
from tutorial_testing.kernel.machine import makes_joysticks
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program

KERNEL = Path(machine.__file__).parent
# Alone each of the two takes some minutes; beside other tests several times as long.
LONGEST_S = 3600.0
# A processor twice as fast as for nodes alone: 0.2 s after a beat the cockpit calls a page late.
SHIFT_OF_PAGE = 0
UDEVD, UDEV_RUNS = "/lib/systemd/systemd-udevd", Path("/run/udev/control")
NOT_HERE = "no /dev/uinput and joydev here, and no machine in the machine"
ROS_ENVIRONMENT = ("PATH", "PYTHONPATH", "CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PKG_CONFIG_PATH")
OWN = ("ROS_IP", "ROS_LOG_DIR")  # of this machine alone


def environment_of_guest():
    """Return what the guest's environment has of this one, as words of env."""
    given = {
        name: value
        for name, value in os.environ.items()
        if (name in ROS_ENVIRONMENT or name.startswith("ROS_")) and name not in OWN
    }
    # A folder of the guest's own: QEMU, which another user than root runs, may not read root's.
    given.update(HOME="/run", ROS_HOSTNAME="localhost", PYTHONUNBUFFERED="1")
    given["ROS_MASTER_URI"] = "http://localhost:11311"
    return [f"{name}={value}" for name, value in given.items()]


def start_in_guest(command, tmp_path, shift):
    """Return (where it runs, the program)."""
    try:
        image, tree = machine.kernel()
    except machine.NoKernelError as error:
        pytest.skip(f"{NOT_HERE}: {error}")
    except machine.MachineError as error:
        pytest.fail(f"{NOT_HERE}: {error}")
    command = ["/usr/bin/env", "-i", *environment_of_guest(), *command]
    machine.make_initramfs(tmp_path / "initramfs", tree, command)
    where = f"in QEMU, {image.name.replace('vmlinuz-', 'Linux ')}"
    return where, Program(*machine.command_of_machine(image, tmp_path / "initramfs", shift))


def run(name, command, here, tmp_path, capsys, *, shift=machine.SHIFT):
    """Run a program to its end, and show what it reports; AssertionError unless it passes."""
    if here:
        uri = f"http://localhost:{free_port()}"
        where, program = f"here, Linux {platform.release()}", Program(*command, ROS_MASTER_URI=uri)
    else:
        where, program = start_in_guest(command, tmp_path, shift)
    with program:
        try:
            status = program.wait(LONGEST_S)
        finally:
            output = program.output
            said = re.findall(r"^drive: .*?(?=\r?$)", output, re.MULTILINE)
            with capsys.disabled():
                print(f"\n{name}, {where}:", *said, sep="\n  ")
            print(output)  # which pytest shows if this fails
    if not here:  # the exit code was that of QEMU
        ended = re.search(f"{machine.EXIT} (\\d+)", output)
        status = int(ended[1]) if ended else None
    assert status == 0
    assert said[-1] == "drive: passed"


def test_a_joystick_of_the_kernel_drives_the_robot(tmp_path, capsys):
    command = ["/usr/bin/python3", str(KERNEL / "drive.py")]
    run("kernel joystick", command, makes_joysticks(), tmp_path, capsys)


def test_chromium_sees_a_joystick_of_the_kernel_and_its_page_drives_the_robot(tmp_path, capsys):
    missing = [name for name in ("chromium", "chromedriver", UDEVD) if not shutil.which(name)]
    if missing or not find_spec("selenium"):
        missing = ", ".join([*missing, *([] if find_spec("selenium") else ["python3-selenium"])])
        pytest.skip(f"{missing} is missing: ./tutorial test browser installs it")
    here = makes_joysticks() and UDEV_RUNS.exists()
    command = ["/usr/bin/python3", str(KERNEL / "drive_page.py")]
    if not here:
        command = ["/bin/sh", "-c", f"{UDEVD} --daemon && exec {shlex.join(command)}"]
    run("kernel joystick in Chromium", command, here, tmp_path, capsys, shift=SHIFT_OF_PAGE)
