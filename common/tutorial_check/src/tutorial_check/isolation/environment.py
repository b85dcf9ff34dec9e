"""The folders and variables in which a student's programs run."""

from __future__ import annotations

from pathlib import Path
from typing import Iterable, Mapping

# RViz is for human eyes: a program of its name only waits.
NO_VIEW = "#!/bin/sh\nexec sleep 600\n"
# With launch-prefix="xterm -e" a node has a window; there is no screen here, so it runs without one.
NO_WINDOW = """#!/bin/sh
while [ $# -gt 1 ] && [ "$1" != -e ] && [ "$1" != -x ] && [ "$1" != -- ]; do shift; done
shift
exec "$@"
"""
STAND_INS = {"rviz": NO_VIEW, **dict.fromkeys(("xterm", "gnome-terminal", "konsole"), NO_WINDOW)}
RVIZ = (
    '<package format="2"><name>rviz</name><version>1.0.0</version><description>x</description>'
    '<maintainer email="a@b.example">x</maintainer><license>x</license></package>'
)


OWN = ("home", "tmp", "ws")  # folders of a session in which the student's programs may write


def environment_of(words: Iterable[str]) -> dict[str, str]:
    """Return the variables of NAME=value words, without those of the shell itself."""
    found = dict(word.split("=", 1) for word in words if "=" in word)
    return {name: found[name] for name in found if name not in ("_", "SHLVL", "PWD", "OLDPWD")}


def variables(folder: Path, environment: Mapping[str, str]) -> dict[str, str]:
    """Return an environment, of a shell that sourced the underlay, with the folders of a session."""
    return {
        **environment,
        "PATH": f"{folder}/bin:{environment['PATH']}",
        "HOME": f"{folder}/home",
        "TMPDIR": f"{folder}/tmp",
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": f"{folder}/home/.ros",
        "ROS_LOG_DIR": f"{folder}/home/.ros/log",
        "DISPLAY": ":99",  # whatever is there: for RViz stands a program that only waits
        "PYTHONUNBUFFERED": "1",
        "PYTHONDONTWRITEBYTECODE": "1",
    }


def prepare(folder: str | Path) -> None:
    """Make the folders of a session."""
    folder = Path(folder)
    for name in (*OWN, "bin", "ours", "view/lib/rviz", "view/src/rviz", "devel"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    # The handout's listings begin with `env python`, as did all in its time.
    (folder / "bin" / "python").symlink_to("/usr/bin/python3")
    for name, text in STAND_INS.items():
        (folder / "bin" / name).write_text(text)
        (folder / "bin" / name).chmod(0o755)
    # RViz for programs that ask ROS where it is, and what a build makes where there is nothing to build.
    (folder / "view/.catkin").write_text(str(folder / "view/src"))
    (folder / "view/src/rviz/package.xml").write_text(RVIZ)
    (folder / "view/lib/rviz/rviz").symlink_to(folder / "bin" / "rviz")
    (folder / "devel/.catkin").write_text(str(folder / "ws" / "src"))
