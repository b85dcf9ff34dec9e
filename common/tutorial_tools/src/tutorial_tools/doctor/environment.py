"""Judge what a terminal and a workspace bring along, which keeps ROS 1 from starting (pure)."""

from __future__ import annotations

from collections.abc import Iterator

from tutorial_tools.doctor.facts import Facts, Finding, ok, wrong

SYSTEMS = "ROS 1 belongs to /usr/bin/python3: export PATH=/usr/bin:$PATH, or ./tutorial shell"


def environment(facts: Facts) -> Iterator[Finding]:
    """Judge the Pythons, ROS 2 in the same terminal, and how the workspace was built."""
    found = [*pythons(facts), *builds(facts)]
    if facts.terminal.ros2:
        todo = "open a terminal in which no setup.bash of ROS 2 is sourced; look into ~/.bashrc"
        seen = f"ROS 2 is in this terminal, too (AMENT_PREFIX_PATH={facts.terminal.ros2})"
        found.append(wrong("environment", seen, todo))
    yield from found
    if facts.terminal.pythons and not found:
        path, origins, _ = facts.terminal.pythons[0]
        yield ok("environment", f"python3 is {path}, with em of {origins['em']}")


def pythons(facts: Facts) -> Iterator[Finding]:
    """Judge whether the Pythons find the modules of ROS, and the right em."""
    for path, origins, has_raw_opt in facts.terminal.pythons:
        missing = [name for name, origin in origins.items() if not origin]
        if missing:
            conda = "conda deactivate; " if "conda" in path or "forge" in path else ""
            seen = f"python3 is {path}, which has no {', '.join(missing)}"
            yield wrong("environment", seen, conda + SYSTEMS)
        elif not has_raw_opt:
            seen = f"{path} takes em from {origins['em']}, which is not empy 3: no message is built"
            todo = f"{path} -m pip uninstall em empy (--break-system-packages, if it asks for that)"
            yield wrong("environment", seen, todo)


def builds(facts: Facts) -> Iterator[Finding]:
    """Judge whether catkin_make can build the workspace, and its programs can start."""
    seen, terminal = "", facts.terminal
    if terminal.built_by not in ("", "catkin_make"):
        seen = f"{facts.workspace}/build was made by {terminal.built_by}, not by catkin_make"
    elif terminal.built_from and terminal.built_from != f"{facts.workspace}/src":
        seen = f"{facts.workspace}/build was made for {terminal.built_from}"
    if seen:
        todo = f"cd {facts.workspace}; rm -r build devel; catkin_make"
        yield wrong("environment", seen, todo)
    for path in terminal.crlf:
        todo = f"sed -i 's/\\r$//' {path}"
        yield wrong("environment", f"{path} has the line ends of Windows", todo)
