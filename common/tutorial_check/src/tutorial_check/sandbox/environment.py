"""The folders and environment variables of a student's programs."""

from __future__ import annotations

import shutil
import stat
from pathlib import Path
from typing import Iterable, Mapping

# What a program sees of the system, read-only.
ETC = "alternatives catkin group host.conf hosts ld.so.cache localtime nsswitch.conf passwd"
SYSTEM = (
    *("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32", "/opt/ros"),
    *(f"/etc/{name}" for name in (*ETC.split(), "python3", "ros")),
)
OWN = ("home", "tmp", "ws")  # folders of a worker that the student's programs may write
STDBUF = "lib*/coreutils/libstdbuf.so"  # the part of coreutils' stdbuf that programs load


def line_buffered() -> dict[str, str]:
    """Return what makes C and C++ programs write each line at once, as into a terminal.

    Into a pipe they would write when they exit, and nothing if they are killed.
    """
    libraries = [str(path) for path in sorted(Path("/usr").glob(STDBUF))[:1]]
    return {"LD_PRELOAD": libraries[0], "_STDBUF_O": "L"} if libraries else {}


def environment_of(words: Iterable[str]) -> dict[str, str]:
    """Return the variables in NAME=value words, without the shell's own."""
    variables = dict(word.split("=", 1) for word in words if "=" in word)
    return {
        name: variables[name] for name in variables if name not in ("_", "SHLVL", "PWD", "OLDPWD")
    }


def variables(folder: Path, environment: Mapping[str, str]) -> dict[str, str]:
    """Return the environment of the underlay, with a worker's folders."""
    return {
        **environment,
        "PATH": f"{folder}/bin:{environment['PATH']}",
        "HOME": f"{folder}/home",
        "TMPDIR": f"{folder}/tmp",
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": f"{folder}/home/.ros",
        "ROS_LOG_DIR": f"{folder}/home/.ros/log",
        "DISPLAY": ":99",  # need not exist: a program that only waits replaces RViz
        **line_buffered(),
        "PYTHONUNBUFFERED": "1",
        "PYTHONDONTWRITEBYTECODE": "1",
    }


def copy_tree(source: Path, target: Path) -> None:
    """Copy a folder of the suite, and make the copy writable."""
    shutil.copytree(source, target, symlinks=True, dirs_exist_ok=True)
    for path in (target, *target.rglob("*")):
        if not path.is_symlink():
            path.chmod(path.stat().st_mode | stat.S_IWUSR)


def prepare(folder: Path) -> None:
    """Make a worker's folders, with stand-ins for programs that need a screen."""
    for name in ("bin", "view"):  # and where ROS finds RViz
        copy_tree(Path(__file__).parent / "without_screen" / name, folder / name)
    for program in (folder / "bin").iterdir():  # in the package they are data
        program.chmod(0o755)
    # The handout's listings begin with `env python`, as was usual then.
    (folder / "bin" / "python").symlink_to("/usr/bin/python3")
    for name in (*OWN, "ours", "devel"):
        (folder / name).mkdir(exist_ok=True)
    # What a build would make if there is nothing to build.
    (folder / "view/.catkin").write_text(str(folder / "view/src"))
    (folder / "devel/.catkin").write_text(str(folder / "ws" / "src"))
