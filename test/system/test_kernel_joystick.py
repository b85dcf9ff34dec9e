"""joy_node and launch_joy_node.launch with a joystick of a real Linux kernel: see kernel/drive.py.

Here, if this kernel makes joysticks; else in QEMU with Debian's kernel: see kernel/machine.py.
"""

import os
import platform
import re
from pathlib import Path

import pytest

from tutorial_testing.processes import Program

KERNEL = Path(__file__).parents[1] / "src" / "tutorial_testing" / "kernel"
from tutorial_testing.kernel.machine import (  # noqa: E402  the folder of this test
    EXIT,
    MachineError,
    NoKernelError,
    command_of_machine,
    kernel,
    make_initramfs,
    makes_joysticks,
)

DEADLINE_S = 900.0  # alone it takes 3 minutes; behind other tests, as .ci/run has it, far longer
NOT_HERE = "no /dev/uinput and joydev here, and no machine in the machine"
ROS_ENVIRONMENT = ("PATH", "PYTHONPATH", "CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PKG_CONFIG_PATH")


def environment_of_guest():
    names = [name for name in os.environ if name in ROS_ENVIRONMENT or name.startswith("ROS_")]
    names = [name for name in names if name not in ("ROS_IP", "ROS_LOG_DIR")]
    given = {name: os.environ[name] for name in names}
    # A folder of the guest's own: QEMU, which another user than root runs, may not read root's.
    given.update(HOME="/run", ROS_HOSTNAME="localhost", PYTHONUNBUFFERED="1")
    given["ROS_MASTER_URI"] = "http://localhost:11311"
    return [f"{name}={value}" for name, value in given.items()]


def drive_here():
    """(where it runs, the program)."""
    program = Program("/usr/bin/python3", str(KERNEL / "drive.py"))
    return f"here, Linux {platform.release()}", program


def drive_in_guest(tmp_path):
    """(where it runs, the program)."""
    try:
        image, tree = kernel()
    except NoKernelError as error:
        pytest.skip(f"{NOT_HERE}: {error}")
    except MachineError as error:
        pytest.fail(f"{NOT_HERE}: {error}")
    command = ["/usr/bin/env", "-i", *environment_of_guest()]
    command += ["/usr/bin/python3", str(KERNEL / "drive.py")]
    make_initramfs(tmp_path / "initramfs", tree, command)
    where = f"in QEMU, {image.name.replace('vmlinuz-', 'Linux ')}"
    return where, Program(*command_of_machine(image, tmp_path / "initramfs"))


@pytest.mark.usefixtures("master_uri")
def test_a_joystick_of_the_kernel_drives_the_robot(tmp_path, capsys):
    here = makes_joysticks()
    where, program = drive_here() if here else drive_in_guest(tmp_path)
    with program:
        try:
            status = program.wait(DEADLINE_S)
        finally:
            output = program.output
            told = re.findall(r"^drive: .*?(?=\r?$)", output, re.MULTILINE)
            with capsys.disabled():
                print(f"\nkernel joystick, {where}:", *told, sep="\n  ")
            print(output)  # which pytest shows if this fails
    if not here:  # the exit code was that of QEMU
        ended = re.search(f"{EXIT} (\\d+)", output)
        status = int(ended[1]) if ended else None
    assert status == 0
    assert told[-1] == "drive: passed"


@pytest.mark.parametrize(
    ("files", "here"),
    [
        (["dev/uinput", "sys/module/joydev"], True),
        (["dev/uinput"], False),
        (["sys/module/joydev"], False),
        ([], False),
        # Another gamepad is plugged in: it would be the one that is opened.
        (["dev/uinput", "sys/module/joydev", "dev/input/js0"], False),
    ],
)
def test_it_runs_here_where_this_kernel_makes_joysticks(tmp_path, files, here):
    for name in files:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    assert makes_joysticks(tmp_path) is here
