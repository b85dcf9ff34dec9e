"""Section 4.5: a recorder with a virtual joystick."""

from __future__ import annotations

from dataclasses import dataclass

from tutorial_check import START_S, CannotCheck, Program, Ran, RosSession, Workspace

from ..task import CMD_VEL, JOY, LB, PACKAGE

SLOW_S = 4.0  # for a program that sleeps in its callback to work off its queue


@dataclass(frozen=True)
class Stick:
    """A run with joy_node and a virtual F710, its switch at D, then with Joys as at X."""

    program: Ran
    drives: bool
    v: float = 0.0  # linear.x of the last Twist [m/s]
    survives_eight_axes: bool = False


def stick(workspace: Workspace, script: str) -> Stick:
    with workspace.ros_session() as ros:
        ros.peer.listen(JOY, "Joy")
        ros.peer.listen(CMD_VEL, "Twist")
        gamepad, path = ros.plug_in()
        node = ros.start_ours("gamepad", "joy_node", f"_dev:={path}", "_autorepeat_rate:=20")
        program = ros.start(PACKAGE, script)

        def has_ended() -> bool:
            return program.ended or node.ended

        def drives() -> bool:
            return any(abs(speed) > 0.01 for speed in _speeds_told(ros))

        def is_up() -> bool:
            return bool(ros.peer.count(JOY) and ros.peer.publishers(CMD_VEL))

        ros.wait(lambda: is_up() or has_ended(), START_S)
        gamepad.push(0.0, 0.6)
        ros.wait(lambda: drives() or has_ended(), 3.0)
        if not ros.peer.count(JOY):
            raise CannotCheck(f"the joystick driver does not start: {node.output[-200:]}")
        if program.ended or not drives():
            return Stick(program.ran, drives=False)
        v = _speeds_told(ros)[-1]
        if v < 0:
            return Stick(program.ran, True, v)
        workspace.runner.end(node)
        survives = _survives_eight_axes(workspace, ros, program)
    return Stick(program.ran, True, v, survives)


def _speeds_told(ros: RosSession, since: int = 0) -> list[float]:
    return [value[0] for _, _, value in ros.peer.received(CMD_VEL, since)]


def _survives_eight_axes(workspace: Workspace, ros: RosSession, program: Program) -> bool:
    ros.peer.advertise(JOY, "Joy")
    # Our own subscriber is one of them.
    ros.wait(lambda: ros.peer.listeners(JOY) > 1 or program.ended, START_S)

    def drive_backwards() -> None:
        """Send the only Joy backwards; its answer shows that all earlier ones are answered."""
        index = ros.peer.count(CMD_VEL)
        ros.peer.send(JOY, workspace.task.held(0.1, -0.5))
        ros.wait(lambda: min(_speeds_told(ros, index), default=0.0) < 0 or program.ended, SLOW_S)

    drive_backwards()
    before, failed = ros.peer.count(CMD_VEL), program.output.count("Traceback")
    for k in range(5):
        axes = (0.1, 0.2 + 0.1 * k, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        joy = axes, (0,) * LB + (1,) + (0,) * 6
        ros.peer.send(JOY, workspace.task.joy(joy))
    drive_backwards()
    has_failed = program.ended or program.output.count("Traceback") != failed
    return not has_failed and max(_speeds_told(ros, before), default=0.0) > 0
