"""Section 6.1: the remapped program, and the launch file for the real TurtleBot, at work."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Tuple

from tutorial_check.processes.errors import CannotCheck
from tutorial_check.recording.data import Topics
from tutorial_check.recording.ground import Ground

from ..launch_files.record import Launch, Plan, Run, drives_forwards, plug_in_for
from ..s4.record import held, rest

TELEOP, ACTIVE = "/cmd_vel_mux/input/teleop", "/cmd_vel_mux/active"


@dataclass(frozen=True)
class Remap:
    """joy2twist_turtlebot, which was sent Joys."""

    run: Run
    good: bool  # velocities came on TELEOP
    bad: bool  # velocities came on the program's own topic
    publishers: Topics
    subscribers: Topics
    others: Tuple[str, ...]  # further topics that may be meant


def remap_run(ground: Ground, plan: Plan, own: str) -> Remap:
    """Run it and send Joys. own: the topic of the velocities as the program has it."""
    with ground.stage(renamed=False) as stage:
        stage.driver.listen(own, "Twist")
        stage.driver.advertise(plan.joys, "Joy")
        launch = Launch(ground, stage, plan)
        topics = (TELEOP, own)

        def others() -> tuple[str, ...]:
            found = (each for each in stage.driver.state()[0] if each not in topics)
            return tuple(sorted(each for each in found if re.search("vel|teleop|mux", each)))

        def is_up() -> bool:
            publishes = any(stage.driver.publishers(each) for each in topics)
            # One of the listeners is ours.
            return stage.driver.listeners(plan.joys) > 1 and bool(publishes or others())

        launch.wait(is_up)
        rest(stage, *topics, joys=plan.joys)
        stage.driver.stream(plan.joys, [held(ground, 0.2, 0.3)], 20.0, True)

        def moving(topic: str) -> bool:
            return any(abs(value[0]) > 0.01 for _, _, value in stage.driver.received(topic))

        stage.wait(lambda: any(map(moving, topics)) or launch.is_over(), 3.0)
        good, bad = map(moving, topics)
        publishers, subscribers = stage.driver.state()
        return Remap(launch.run(good), good, bad, publishers, subscribers, others())


def real_run(ground: Ground, plan: Plan, has_base: bool) -> Run:
    """Run the file for the real TurtleBot beside a simulated one, and push the stick."""
    with ground.stage(renamed=False) as stage:
        stage.driver.listen(ACTIVE, "String")
        gamepad, base = plug_in_for(ground, stage, plan), None
        if not has_base:
            command = ["roslaunch", "fake_turtlebot_sim", "minimal.launch", "model:=false"]
            base = stage.launch(command, trusted=True)
        launch = Launch(ground, stage, plan)
        drives = drives_forwards(stage, gamepad, launch, ACTIVE)
        if base and base.ended:
            raise CannotCheck(f"the simulated TurtleBot does not start: {base.output[-200:]}")
        active = {value for _, _, value in stage.driver.texts(ACTIVE)}
        return launch.run(drives, active=tuple(sorted(active)))
