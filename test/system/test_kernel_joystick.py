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

from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

KERNEL = Path(__file__).parents[1] / "src" / "tutorial_testing" / "kernel"
from tutorial_testing.kernel.machine import (  # noqa: E402  the folder of this test
    EXIT,
    SHIFT,
    MachineError,
    NoKernelError,
    command_of_machine,
    kernel,
    make_initramfs,
    makes_joysticks,
)

# Without a new line of the program. Alone each of the two takes some minutes, the start of Chromium
# more than one of them; how long beside other tests is theirs to say.
SILENT_S = 900.0
# A processor twice as fast as for nodes alone: 0.2 s after a beat the cockpit calls a page late.
SHIFT_OF_PAGE = 0
UDEVD, UDEV_RUNS = "/lib/systemd/systemd-udevd", Path("/run/udev/control")
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


def start_here(command):
    """(where it runs, the program)."""
    return f"here, Linux {platform.release()}", Program(*command)


def start_in_guest(command, tmp_path, shift):
    """(where it runs, the program)."""
    try:
        image, tree = kernel()
    except NoKernelError as error:
        pytest.skip(f"{NOT_HERE}: {error}")
    except MachineError as error:
        pytest.fail(f"{NOT_HERE}: {error}")
    command = ["/usr/bin/env", "-i", *environment_of_guest(), *command]
    make_initramfs(tmp_path / "initramfs", tree, command)
    where = f"in QEMU, {image.name.replace('vmlinuz-', 'Linux ')}"
    return where, Program(*command_of_machine(image, tmp_path / "initramfs", shift))


def wait_while_it_speaks(program):
    """Wait for the end of a Program; return its exit code. AssertionError if it falls silent."""
    while not program.ended:
        said = len(program.output)
        wait_for(
            lambda: program.ended or len(program.output) > said,  # noqa: B023  called at once
            f"further line, after:\n{program.output}",
            SILENT_S,
        )
    return program.wait()


def run(name, command, here, tmp_path, capsys, *, shift=SHIFT):
    """Run a program to its end, and show what it tells; AssertionError unless it says "passed"."""
    where, program = start_here(command) if here else start_in_guest(command, tmp_path, shift)
    with program:
        try:
            status = wait_while_it_speaks(program)
        finally:
            output = program.output
            said = re.findall(r"^drive: .*?(?=\r?$)", output, re.MULTILINE)
            with capsys.disabled():
                print(f"\n{name}, {where}:", *said, sep="\n  ")
            print(output)  # which pytest shows if this fails
    if not here:  # the exit code was that of QEMU
        ended = re.search(f"{EXIT} (\\d+)", output)
        status = int(ended[1]) if ended else None
    assert status == 0
    assert said[-1] == "drive: passed"


@pytest.mark.usefixtures("master_uri")
def test_a_joystick_of_the_kernel_drives_the_robot(tmp_path, capsys):
    command = ["/usr/bin/python3", str(KERNEL / "drive.py")]
    run("kernel joystick", command, makes_joysticks(), tmp_path, capsys)


@pytest.mark.usefixtures("master_uri")
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
