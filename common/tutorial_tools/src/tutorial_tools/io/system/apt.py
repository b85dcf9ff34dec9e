"""Queries to dpkg and apt, and apt-get as root, with its progress."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Iterable, Iterator, Sequence

from tutorial_tools.errors import SetUpError

# No retries: without a network they would take minutes for each of hundreds of packages.
APT_GET = (
    *("env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-q", "-y", "--no-install-recommends"),
    *("-o", "Acquire::Retries=0", "-o", "DPkg::Lock::Timeout=300"),
)
# Scripts for root. They print the status lines, as sudo closes all other files. Ctrl-C ends the
# first; the second runs dpkg in another session, which Ctrl-C does not reach. The exit code reports
# Ctrl-C where sudo passes it only to the command that it runs.
CAN_BE_CUT = 'exec "$@" 3>&1 1>&2'
IS_FINISHED = """trap 'status=130; echo interrupted:' INT
setsid "$@" 3>&1 1>&2 &
until wait $!; do kill -0 $! || exit ${status-1}; done
exit ${status-0}"""
INTERRUPTED = 130  # exit code
FINISHES = "interrupted: what is being installed is finished first, as dpkg must not be cut"
AS_ROOT = "As root, run: ./tutorial setup system"


def say(line: str) -> None:
    """Report to the user."""
    print(f"tutorial: {line}", file=sys.stderr, flush=True)


def _ask(*command: str) -> subprocess.CompletedProcess[str]:
    english = {**os.environ, "LC_ALL": "C"}
    return subprocess.run(command, check=False, env=english, text=True, capture_output=True)


def not_installed(names: Sequence[str]) -> list[str]:
    """Return those of the named packages that are not installed."""
    query = ("dpkg-query", "-W", "-f", "${db:Status-Status} ${Package}\n", *names)
    known = set(_ask(*query).stdout.splitlines()) if names else ()
    return [name for name in names if f"installed {name}" not in known]


def lacking(names: Sequence[str]) -> list[str]:
    """Return the packages that apt cannot install, as the archive lacks them or what they need."""
    if _can_install(*names):
        return []
    policy = _ask("apt-cache", "policy", *names).stdout
    candidates = re.findall(r"^(\S+):\n(?: .*\n)*?  Candidate: (?!\(none\))", policy, re.M)
    offered = [name for name in names if name in candidates]
    if not _can_install(*offered):  # one by one, which takes minutes
        offered = list(filter(_can_install, offered))
    return [name for name in names if name not in offered]


def _can_install(*names: str) -> bool:
    simulation = ("apt-get", "install", "-s", "-q", "--no-install-recommends", *names)
    return _ask(*simulation).returncode == 0


def size_of(names: Sequence[str]) -> str:
    """Return the size of the download, such as " of 245 MB"; "" if apt does not know it."""
    uris = _ask("apt-get", "install", "--print-uris", "-qq", "--no-install-recommends", *names)
    total = sum(map(int, re.findall(r"^'\S+' \S+ (\d+)", uris.stdout, re.M)))
    return f" of {total / 1e6 + 0.5:.0f} MB" if total else ""


def as_root(*command: str) -> list[str]:
    """Return the command that runs this one as root. Raises SetUpError."""
    if _ask("id", "-u").stdout.strip() == "0":
        return [*command]
    if not shutil.which("sudo"):
        raise SetUpError(f"not root, and no sudo here. {AS_ROOT}")
    return ["sudo", *command]


def progress(status: Iterable[str], size: str) -> Iterator[str]:
    """Yield the progress in steps of ten percent, from apt's status lines."""
    shown = -1
    for line in status:
        kind, _, percent, *_ = f"{line.strip()}:::".split(":")
        if kind == "interrupted":
            yield FINISHES
        elif kind in ("dlstatus", "pmstatus") and int(float(percent)) // 10 != shown:
            shown = int(float(percent)) // 10
            what, of = ("download", size) if kind == "dlstatus" else ("install", "")
            yield f"   {what} {int(float(percent))} %{of}"


def apt_get(log: Path, script: str, *arguments: str, size: str = "") -> bool:
    """Call apt-get as root, show its progress, and return whether it succeeded."""
    command, pipe = as_root("sh", "-c", script, "sh", *APT_GET, *arguments), subprocess.PIPE
    with open(log, "a", encoding="utf-8") as words:
        apt = subprocess.Popen(command, errors="replace", stdout=pipe, stderr=words)
    with apt:
        if script == IS_FINISHED:
            signal.signal(signal.SIGINT, signal.SIG_IGN)
        for line in progress(apt.stdout or (), size):
            say(line)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    if apt.returncode in (INTERRUPTED, -signal.SIGINT):
        raise KeyboardInterrupt
    return apt.returncode == 0


def download_and_install(log: Path, names: Sequence[str]) -> bool:
    """Download, which may be interrupted, then install; return whether both succeeded."""
    arguments, size = ("install", "-o", "APT::Status-Fd=3", *names), size_of(names)
    is_there = apt_get(log, CAN_BE_CUT, *arguments, "--download-only", size=size)
    return is_there and apt_get(log, IS_FINISHED, *arguments)


def errors(log: Path) -> list[str]:
    """Return the last errors in apt's output."""
    return re.findall("^(?:Err:|E: ).*", log.read_text(errors="replace"), re.M)[-5:]
