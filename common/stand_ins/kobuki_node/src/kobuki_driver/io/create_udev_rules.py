"""Install the udev rule for a Kobuki's USB cable, as root or through sudo."""

from __future__ import annotations

import argparse
import grp
import os
import pwd
import shutil
import subprocess
import sys
from pathlib import Path

from kobuki_driver.link.udev_rules import FOLDER, GROUP, NAME, RULES

RELOAD = ("udevadm", "control", "--reload-rules")
TRIGGER = ("udevadm", "trigger", "--action=add", "--subsystem-match=usb-serial")
TRIGGER_TTY = ("udevadm", "trigger", "--action=add", "--subsystem-match=tty")
NO_UDEV = "udev does not run here, as in a container: run this on the computer itself"


def main() -> int:
    """Install the rule; return the exit code."""
    reader = argparse.ArgumentParser(description=__doc__)
    reader.add_argument("--folder", default=FOLDER, help="where rules are (%(default)s)")
    folder = Path(reader.parse_args().folder)
    if os.geteuid() != 0 and not os.access(folder, os.W_OK):
        return _as_root()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / NAME).write_text(RULES)
    except OSError as error:
        print(f"create_udev_rules: {folder / NAME}: {error.strerror}", file=sys.stderr)
        return 1
    print(f"create_udev_rules: {folder / NAME}: a Kobuki is /dev/kobuki from now on")
    if str(folder) == FOLDER:
        _apply()
    print(f"create_udev_rules: {_membership()}")
    return 0


def _as_root() -> int:
    """Run this again through sudo, with PYTHONPATH, which sudo drops."""
    sudo = shutil.which("sudo")
    if not sudo:
        print("create_udev_rules: only root may do this: run it as root", file=sys.stderr)
        return 1
    path = "PYTHONPATH=" + os.environ.get("PYTHONPATH", "")
    os.execv(sudo, [sudo, "env", path, sys.executable, *sys.argv])


def _apply() -> None:
    try:
        for command in (RELOAD, TRIGGER, TRIGGER_TTY):
            subprocess.run(command, check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        print(f"create_udev_rules: {NO_UDEV}; or plug the cable in again", file=sys.stderr)


def _membership() -> str:
    """Return a line about the user's membership in the group of the port."""
    user = os.environ.get("SUDO_USER") or pwd.getpwuid(os.getuid()).pw_name
    if user == "root":
        return f"users of the robot need the group {GROUP}: usermod -aG {GROUP} NAME"
    try:
        is_member = user in grp.getgrnam(GROUP).gr_mem
    except KeyError:
        is_member = False
    if is_member:
        return f"{user} is in the group {GROUP}"
    return f"{user} needs the group {GROUP}: sudo usermod -aG {GROUP} {user}; then log in again"
