"""What a hostile program reaches in each mode, compared with the README's table."""

import ctypes
import json
import os
import re
import shutil
import socket
import subprocess
import tempfile
from pathlib import Path

import pytest
from attack import ATTACKS, FILLS_MEMORY, LEAVE, in_memory
from solution import B
from test_awkward import PYTHONPATH, SOURCE, command
from test_endings import path_without_namespaces
from test_hostile import processes_like

from tutorial_check.sandbox import bubblewrap, landlock
from tutorial_testing.claims import claim
from tutorial_testing.isolation import old_bubblewrap
from tutorial_testing.processes import REPOSITORY

MODES = (
    *("root", "a user", "root, Landlock", "a user, Landlock"),
    *("root, not isolated", "a user, not isolated"),
)
# Imitations of bubblewrap 0.4 (Ubuntu 20.04) and Linux 5.13, each with its mode.
OLDER = {
    **{f"{mode}, bubblewrap 0.4": mode for mode in MODES[:2]},
    **{f"{mode} of Linux 5.13": mode for mode in MODES[2:4]},
}
OF_LINUX_5_13 = """
from tutorial_check.sandbox import landlock
landlock.version = lambda: 1
"""
REMARKS = {"Landlock": "isolated by Landlock alone", "not isolated": "not isolated"}
STRANGER = 65533  # an ordinary user
FILLS = "fill your memory with files"
LINK, FORGES, FILES, SHARED, PROCESS = (
    "read it through a link that the checker follows",
    "write a verdict of its own",
    "leave files in /tmp, /var/tmp, /dev/shm",
    "leave System V shared memory",
    "leave a process",
)
BUILD = """
execute_process(COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/attack.py
  OUTPUT_VARIABLE said ERROR_VARIABLE said)
message(FATAL_ERROR "${said}")
"""


def promised():
    """Return {mode: what a program can do}, from the README."""
    lines = (SOURCE.with_name("README.md")).read_text().splitlines()
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if "|" in line]
    begin = next(at for at, row in enumerate(rows) if row[1:] == list(MODES))
    table = [row for row in rows[begin + 2 :] if len(row) == 1 + len(MODES)]
    assert {row[0] for row in table} == {*ATTACKS, LINK, FORGES, FILES, SHARED, PROCESS}
    assert {cell for row in table for cell in row[1:]} == {"no", "yes"}
    return {
        mode: {row[0] for row in table if row[column] == "yes"}
        for column, mode in enumerate(MODES, 1)
    }


def has_vsock():
    try:
        return socket.socket(socket.AF_VSOCK, socket.SOCK_STREAM).close() is None
    except OSError:
        return False


def impossible(words, mode):
    """Return what no program can do on this machine in any mode."""
    can_mount = "Landlock" not in mode and subprocess.call([*words, *FILLS_MEMORY]) == 0
    has_memory = in_memory(tempfile.gettempdir())
    is_connected = len(socket.if_nameindex()) > 1
    return {
        *(() if can_mount or has_memory else (FILLS,)),
        *(() if is_connected else ("reach your network",)),
        *(() if has_vsock() else ("reach your machine past its network",)),
    }


@pytest.fixture(params=[*MODES, *OLDER])
def older(request):
    """A mode, or its imitation with older software."""
    mode = OLDER.get(request.param, request.param)
    if mode.startswith("root") and os.geteuid() != 0:
        pytest.skip("only root can try what holds for root")
    if mode.endswith("Landlock") and not landlock.version():
        pytest.skip("no Landlock here")
    if mode in MODES[:2] and not bubblewrap.granted().options:
        pytest.skip(f"no isolation here: {bubblewrap.granted().why}")
    return request.param


@pytest.fixture
def mode(older):
    return OLDER.get(older, older)


@pytest.fixture
def variables(older, mode, folder):
    """The checker's environment."""
    variables = {**os.environ, "PYTHONPATH": PYTHONPATH, "HOME": str(folder / "home")}
    if mode not in MODES[:2]:
        variables["PATH"] = path_without_namespaces(folder)
    elif older != mode:
        variables["PATH"] = f"{old_bubblewrap(folder)}:{os.environ['PATH']}"
    if older.endswith("Linux 5.13"):
        (folder / "old").mkdir()
        (folder / "old" / "sitecustomize.py").write_text(OF_LINUX_5_13)
        variables["PYTHONPATH"] = f"{folder}/old:{PYTHONPATH}"
    return variables


@pytest.fixture
def words(mode, folder):
    # On machines whose system call numbers the suite does not know, it uses no Landlock.
    machine = ["setarch", "i686"] if mode.endswith("not isolated") else []
    if not mode.startswith("a user") or os.geteuid() != 0:
        return machine
    return [*machine, "setpriv", f"--reuid={STRANGER}", f"--regid={STRANGER}", "--clear-groups"]


@claim(
    "A hostile program reaches what the README's table says, in each of six modes, and with "
    "bubblewrap 0.4 and the Landlock of Linux 5.13"
)
def test_a_hostile_program_reaches_what_the_readme_says(
    literal, older, mode, folder, bare_underlay, words, variables
):
    name, number = f"attack_{os.getpid()}", 0x60000000 + os.getpid()
    home, group = folder / "home", folder / "group"
    (group / "bob").mkdir(parents=True)
    (group / "bob" / "secret").write_text("x")
    shutil.move(literal.parent, group / "ada")
    shutil.rmtree(group / "ada" / "src" / "joy2twist")
    package = group / "ada" / "src" / B
    shutil.copy(Path(__file__).with_name("attack.py"), package)
    with (package / "CMakeLists.txt").open("a") as file:
        file.write(BUILD)
    home.mkdir(0o700)
    (home / "secret").write_text("<html>")  # the checker would report a web page
    (home / "secret").chmod(0o600)
    libc, remove = ctypes.CDLL(None), 0
    left = [Path(place) / name for place in LEAVE]
    with socket.create_server(("127.0.0.1", 0)) as server, socket.socket(socket.AF_UNIX) as desktop:
        desktop.bind(f"\0{name}")
        desktop.listen()
        aims = {"home": home, "other": group / "bob" / "secret", "name": name, "number": number}
        aims["solution"] = REPOSITORY / "joy2twist" / "CMakeLists.txt"
        aims["original"] = package / "CMakeLists.txt"
        aims = {key: value if key == "number" else str(value) for key, value in aims.items()}
        subject = subprocess.Popen([*words, "sh", "-c", "read line", name], stdin=subprocess.PIPE)
        aims["process"] = subject.pid
        (package / "aims.json").write_text(json.dumps({**aims, "port": server.getsockname()[1]}))
        if words:
            subprocess.run(["chown", "-R", str(STRANGER), home, group], check=True)
        try:
            done = subprocess.run(
                [*words, *command(bare_underlay, "--all", group, "2", "3")],
                capture_output=True, text=True, check=False, timeout=600, env=variables,
                preexec_fn=lambda: os.umask(0o077),  # programs can read the copy with any umask
            )  # fmt: skip
            report = (group / "check" / "ada.txt").read_text()
            numbers = re.search(r"reached:([\d ]*) \.", report)
            assert numbers, report + done.stderr
            reached = {list(ATTACKS)[int(attack)] for attack in numbers[1].split()}
            # printed before the first verdict
            assert ("no isolation here" in done.stderr) == mode.endswith("not isolated")
            said = REMARKS.get(mode.rpartition(", ")[2], "")
            judged = json.loads((group / "check/ada.json").read_text())["exercises"][0]
            assert judged["remark"] == said and (f"({said})" in report or not said)
            seen = {
                LINK: "a web page" in report,
                FORGES: "FORGED" in report,
                FILES: any(path.exists() for path in left),
                SHARED: libc.shmget(number, 1, 0) >= 0,
                PROCESS: bool(processes_like(f"sleep\0{number}\0")),
            }
            reached |= {what for what, is_so in seen.items() if is_so}
            # An old bubblewrap does not limit folders, and the checker prints that.
            has_limits = older == mode or mode not in MODES[:2]
            assert ("does not limit the memory" in done.stderr) == (not has_limits)
            expected = promised()[mode] | ({FILLS} if not has_limits else set())
            assert reached == expected - impossible(words, mode)
        finally:
            subject.communicate()
            libc.shmctl(libc.shmget(number, 1, 0), remove, None)
            for path in left:
                path.unlink(missing_ok=True)
            for pid in processes_like(f"sleep\0{number}\0"):
                os.kill(int(pid), 9)
