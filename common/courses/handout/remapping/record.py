"""Section 6.1: recorders of the remapped program and the real TurtleBot's launch file."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Tuple

from tutorial_check import CannotCheck, Topics, Workspace

from ..driving.record import rest
from ..launch_runs.record import LaunchRun, Plan, RunningLaunch, drives_forwards, plug_in_for

TELEOP, ACTIVE = "/cmd_vel_mux/input/teleop", "/cmd_vel_mux/active"


@dataclass(frozen=True)
class Remap:
    """A run of joy2twist_turtlebot that was sent Joys."""

    run: LaunchRun
    good: bool  # velocities came on TELEOP
    bad: bool  # velocities came on the program's own topic
    publishers: Topics
    subscribers: Topics
    others: Tuple[str, ...]  # other topics that the student may mean


def remap_run(workspace: Workspace, plan: Plan, own: str) -> Remap:
    """Run it and send Joys. own: the program's own topic for velocities."""
    with workspace.ros_session(renamed=False) as ros:
        ros.peer.listen(own, "Twist")
        ros.peer.advertise(plan.joys, "Joy")
        launch = RunningLaunch(workspace, ros, plan)
        topics = (TELEOP, own)

        def others() -> tuple[str, ...]:
            names = (name for name in ros.peer.state()[0] if name not in topics)
            return tuple(sorted(name for name in names if re.search("vel|teleop|mux", name)))

        def is_up() -> bool:
            publishes = any(map(ros.peer.publishers, topics))
            # One of the listeners is ours.
            return ros.peer.listeners(plan.joys) > 1 and bool(publishes or others())

        launch.wait(is_up)
        rest(ros, *topics, joys=plan.joys)
        ros.peer.stream(plan.joys, [workspace.task.held(0.2, 0.3)], 20.0, True)

        def moving(topic: str) -> bool:
            return any(abs(value[0]) > 0.01 for _, _, value in ros.peer.received(topic))

        ros.wait(lambda: any(map(moving, topics)) or launch.is_over, 3.0)
        good, bad = map(moving, topics)
        publishers, subscribers = ros.peer.state()
        return Remap(launch.run(good), good, bad, publishers, subscribers, others())


def real_run(workspace: Workspace, plan: Plan, has_base: bool) -> LaunchRun:
    """Run the file for the real TurtleBot with a simulated one, and push the stick."""
    with workspace.ros_session(renamed=False) as ros:
        ros.peer.listen(ACTIVE, "String")
        gamepad, base = plug_in_for(workspace, ros, plan), None
        if not has_base:
            command = ["roslaunch", "fake_turtlebot_sim", "minimal.launch", "model:=false"]
            base = ros.launch(command, trusted=True)
        launch = RunningLaunch(workspace, ros, plan)
        drives = drives_forwards(ros, gamepad, launch, ACTIVE)
        if base and base.ended:
            raise CannotCheck(f"the simulated TurtleBot does not start: {base.output[-200:]}")
        active = {value for _, _, value in ros.peer.texts(ACTIVE)}
        return launch.run(drives, active=tuple(sorted(active)))
