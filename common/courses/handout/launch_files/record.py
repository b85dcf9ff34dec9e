"""Section 5: recorders that run launch files with a bag of the checker's, and with a joystick."""

from __future__ import annotations

import os
from pathlib import Path

from tutorial_check import ODOM, Workspace

from ..launch_runs.record import LaunchRun, Plan, RunningLaunch, drives_forwards, plug_in_for
from ..task import NEUTRAL

BAG_S = 1.2  # length of the bag that replaces the student's and is repeated
FAR_M = 0.3  # least distance to drive


def bag_run(
    workspace: Workspace, plan: Plan, bag: str, length_s: float, is_looped: bool
) -> LaunchRun:
    """Run launch_bag. bag: within src, to be replaced by one of that length; or empty."""
    if bag:
        _own_bag(workspace, workspace.source / bag, length_s)
    with workspace.ros_session(renamed=False) as ros:
        launch = RunningLaunch(workspace, ros, plan)
        drives = launch.wait(lambda: launch.moved_m() > FAR_M)
        loops = is_looped
        # A robot that is driven by another topic does not show that /joy drives it.
        if drives and is_looped and bag and ros.peer.count(plan.joys):
            end_s = ros.peer.received(plan.joys)[0][0] + length_s + 0.5
            loops = bool(
                ros.wait(lambda: ros.peer.received(plan.joys)[-1][0] > end_s, length_s + 2.5)
            )
        return launch.run(drives, loops=loops)


def _own_bag(workspace: Workspace, path: Path, length_s: float) -> None:
    """Replace the student's bag by one with LB released at rest, then a drive forwards."""
    import rosbag  # noqa: PLC0415
    import rospy  # noqa: PLC0415
    from sensor_msgs.msg import Joy  # noqa: PLC0415

    mode = os.stat(path).st_mode
    os.unlink(path)
    with rosbag.Bag(str(path), "w") as bag:
        for k in range(int(length_s * 20)):
            stamp = rospy.Time(1_600_000_000 + k / 20)
            axes, buttons = workspace.task.held(0.0, 1.0) if k > 4 else NEUTRAL
            joy = Joy(axes=axes, buttons=buttons)
            joy.header.stamp = stamp
            bag.write("/joy", joy, stamp)
    os.chmod(path, mode | 0o444)


def stick_run(workspace: Workspace, plan: Plan) -> LaunchRun:
    """Run launch_joy_node, push the stick and release it."""
    with workspace.ros_session(renamed=False) as ros:
        gamepad = plug_in_for(workspace, ros, plan)
        launch = RunningLaunch(workspace, ros, plan)
        if not drives_forwards(ros, gamepad, launch):
            return launch.run(drives=False)
        gamepad.release()

        def rests() -> bool:
            return abs(ros.peer.received(ODOM, -1)[0][2][5]) <= 0.01

        return launch.run(drives=True, rests=bool(ros.wait(rests, 3.0)))
