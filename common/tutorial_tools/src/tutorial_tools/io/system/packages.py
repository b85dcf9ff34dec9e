"""Reads the list of Debian packages, and installs those that are missing."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from tutorial_tools.errors import SetUpError
from tutorial_tools.io.system import apt
from tutorial_tools.io.system.apt import AS_ROOT, say

LIST = Path(__file__).resolve().parents[4] / "etc" / "packages"
INCLUDES = {"more": ("view",), "view": ("qt6",)}  # section: others that it includes
ANYWHERE = ("browser", "qt6", "cluster")  # sections that do not depend on where ROS comes from
QT6 = ("trixie", "forky", "sid")  # Debian's releases with RViz for Qt 6
DONE = "set up; next: ./tutorial demo"


def system() -> dict[str, str]:
    """Return the fields of /etc/os-release."""
    text = Path("/etc/os-release").read_text(encoding="utf-8")
    return dict(re.findall(r'^(\w+)="?(.*?)"?$', text, re.M))


def packages(*sections: str) -> list[str]:
    """Return the packages of these sections, except the sections in TUTORIAL_WITHOUT."""
    ros = os.environ.get("TUTORIAL_ROS", "")
    left_out = os.environ.get("TUTORIAL_WITHOUT", "").split()
    if system().get("VERSION_CODENAME") not in QT6:
        left_out.append("qt6")
    text = re.sub(" *#.*", "", LIST.read_text(encoding="utf-8"))
    parts = re.split(r"^\[(.+)\]$", text.replace("DISTRO", os.path.basename(ros)), flags=re.M)
    listed = dict(zip(parts[1::2], parts[2::2]))
    names: list[str] = []
    for section in sections:
        if section not in left_out:
            name = f"opt-{section}" if ros and section not in ANYWHERE else section
            names += [*packages(*INCLUDES.get(section, ())), *listed[name].split()]
    return names


def install(wanted: list[str], workspace: Path, again: bool) -> None:
    """Install those of these packages that are missing. Raises SetUpError.

    A file in the workspace lists what the archive lacks, which is reported once. again: try these
    packages, too.
    """
    if wanted and not shutil.which("apt-get"):
        todo = "this needs Debian 12 or 13, or Ubuntu 22.04 or 24.04; elsewhere use docker/"
        raise SetUpError(f"no apt-get here: {todo}")
    kept = workspace / "lacking"
    if again:
        kept.unlink(missing_ok=True)
    known = kept.read_text().split() if kept.exists() else []
    missing = [name for name in apt.not_installed(wanted) if name not in known]
    if not missing:
        return
    say(f"installing {len(missing)} Debian packages and what they need: {' '.join(missing)}")
    if subprocess.run(apt.as_root("true"), check=False).returncode:
        raise SetUpError(f"sudo was refused. {AS_ROOT}")
    descriptor, log = tempfile.mkstemp()
    os.close(descriptor)
    try:
        _install(missing, kept, Path(log))
    except KeyboardInterrupt:
        os.remove(log)
        raise
    os.remove(log)


def _elsewhere() -> str:
    """Return what to do if the archive lacks a necessary package."""
    ros = os.environ.get("TUTORIAL_ROS", "")
    if ros:
        return f"they are where {ros} comes from; is that still in /etc/apt/sources.list.d?"
    return "take Debian 12 or 13, or docker/"


def _install(missing: list[str], kept: Path, log: Path) -> None:
    apt.apt_get(log, apt.CAN_BE_CUT, "update")  # an unreachable mirror fails in the installation
    unreached, lacking = apt.errors(log), apt.lacking(missing)
    archive = f"the archive of {system()['PRETTY_NAME']} lacks"
    words = f"(apt's output is in {log})"
    needed = [name for name in lacking if name in packages("demo")]
    if needed and not unreached:
        why = f"{archive} {' '.join(needed)}, without which nothing drives {words}"
        raise SetUpError(f"{why}: {_elsewhere()}")
    if lacking and not needed:
        missing = [name for name in missing if name not in lacking]
        if unreached:  # so the archive may have them
            why = f"as apt does not reach all of its archives: {' '.join(lacking)}"
            say(f"done without this time, {why}. Check the network")
        else:
            say(f"done without, as {archive} it: {' '.join(lacking)}")
            kept.parent.mkdir(parents=True, exist_ok=True)
            with open(kept, "a", encoding="utf-8") as file:
                print(*lacking, sep="\n", file=file)
    if missing and not apt.download_and_install(log, missing):
        print(*(f"   {error}" for error in apt.errors(log)), sep="\n", file=sys.stderr)
        failed = " ".join(apt.not_installed(missing))
        todo = "then run ./tutorial setup again: it goes on where it stopped"
        raise SetUpError(f"not installed: {failed}. Check the network {words}, {todo}")
