"""A hostile program for test_isolation.py: it prints the attacks that succeeded."""

import contextlib
import ctypes
import glob
import json
import os
import pathlib
import socket
import subprocess

HERE = pathlib.Path(__file__).parent
FORGED = '\n{"exercise": "2", "result": {"id": "FORGED", "status": "ok", "title": "x"}}\n'
LEAVE = ("/tmp", "/var/tmp", "/dev/shm", "/run/lock")
FILLS_MEMORY = ["unshare", "--user", "--map-root-user", "--mount",
                "mount", "-t", "tmpfs", "none", "/mnt"]  # fmt: skip
aims = {}


def connect(family, address):
    with socket.socket(family) as probe:
        probe.settimeout(5.0)
        return probe.connect_ex(address) == 0


def read(path):
    return pathlib.Path(path).read_text()


def write(path, mode="w"):
    """Make a file, or append to it; return True."""
    with open(path, mode) as file:
        file.write("\n")
    return True


def above():
    """Yield the checker's processes among this one's ancestors, as folders of /proc."""
    process = pathlib.Path("/proc/self")
    while process.name != "0":
        if b"tutorial_check" in (process / "cmdline").read_bytes():
            yield process
        parent = read(process / "stat").rsplit(")", 1)[1].split()[1]
        process = pathlib.Path("/proc", parent)


def forge():
    """Write a verdict into each pipe of the checker; the test sees later whether it was read."""
    own = {os.readlink(f"/proc/self/fd/{number}") for number in (0, 1, 2)}
    for process in above():
        for path in glob.glob(f"{process}/fd/*"):
            with contextlib.suppress(OSError):
                pipe = os.readlink(path)
                if pipe.startswith("pipe:") and pipe not in own:
                    os.write(os.open(path, os.O_WRONLY | os.O_NONBLOCK), FORGED.encode())


def plant():
    """Leave a link where the checker reads later; its report shows whether it followed it."""
    script = HERE / "scripts" / "talker.py"
    script.unlink()
    script.symlink_to(f"{aims['home']}/secret")


def leave():
    """Leave files, shared memory and a process; the test sees later whether they remain."""
    for folder in LEAVE:
        with contextlib.suppress(OSError):
            write(f"{folder}/{aims['name']}")
    ctypes.CDLL(None).shmget(aims["number"], 4096, 0o1666)
    if os.fork() == 0:
        os.setsid()
        nothing = subprocess.DEVNULL
        command = ["/bin/sleep", str(aims["number"])]
        subprocess.Popen(command, env={}, stdin=nothing, stdout=nothing, stderr=nothing)
        os._exit(0)


def processes():
    for path in glob.glob("/proc/[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            yield pathlib.Path(path).read_bytes()


def in_memory(folder):
    """Return whether a folder is in memory and has room for more than 1 GB."""
    kind = subprocess.run(["stat", "-f", "-c", "%T", folder], stdout=subprocess.PIPE, check=False)
    about = os.statvfs(folder)
    return kind.stdout == b"tmpfs\n" and about.f_blocks * about.f_frsize > 1 << 30


def rights():
    """Return whether it has rights, or may gain them from another program."""
    status = dict(line.split(":") for line in read("/proc/self/status").splitlines())
    return int(status["CapEff"], 16) or not int(status["NoNewPrivs"])


ATTACKS = {
    "read a private file of yours": lambda: read(f"{aims['home']}/secret"),
    "write into your home folder": lambda: write(f"{aims['home']}/new"),
    "read another student's files": lambda: read(aims["other"]),
    "change another student's files": lambda: write(aims["other"], "a"),
    "change the rights of your files": lambda: os.chmod(aims["home"], 0o700) is None,
    "end your processes": lambda: os.kill(aims["process"], 0) is None,
    "change what you check": lambda: os.truncate(aims["original"], 0) is None,
    "read this suite's solutions": lambda: read(aims["solution"]),
    "reach your network": lambda: len(socket.if_nameindex()) > 1,
    "reach your machine past its network": lambda: (
        socket.socket(socket.AF_VSOCK, socket.SOCK_STREAM).close() is None
    ),
    "reach your roscore": lambda: connect(socket.AF_INET, ("127.0.0.1", aims["port"])),
    "reach the sockets of your desktop": lambda: (
        os.listdir("/run") or connect(socket.AF_UNIX, f"\0{aims['name']}")
    ),
    "see your processes": lambda: any(aims["name"].encode() in command for command in processes()),
    "gain rights, as by sudo": rights,
    "fill your memory with files": lambda: subprocess.call(FILLS_MEMORY) == 0 or in_memory("."),
}


def main():
    aims.update(json.loads((HERE / "aims.json").read_text()))
    reached = []
    for number, attack in enumerate(ATTACKS.values()):  # the report would cut off names
        with contextlib.suppress(OSError):
            if attack():
                reached.append(str(number))
    forge()
    leave()
    plant()
    print("reached:", *reached, ".")


if __name__ == "__main__":
    main()
