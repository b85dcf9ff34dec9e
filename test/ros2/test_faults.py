"""Random faults of the bridge while ROS 2 drives the robot: ./tutorial test faults --bridge.

The class in ROS 2 is the handout's and obeys any Joy. So what is judged is the bridge's: the wheels
rest in time when a part of the way is lost (d), nothing that waited anywhere moves them later (f),
and the robot is driven again once all is back (h).
"""

import contextlib
import os
import random
import signal
import time

import rospy
from drive import CLASS, REST_S, Stick, moves
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.waiting import wait_for

OLD_S = 0.5  # how old the list lets a Joy be, and a velocity
LONG = 10 * (1 << 18)  # axes of a Joy of ten megabytes
PROGRAM = "program"
FAULTS = (
    "kill:ROS 1", "stop:ROS 1", "kill:ROS 2", "stop:ROS 2", "end:ROS 2", "kill:program",
    "stop:program", "end:program", "strange:joy", "strange:scan", "strange:chatter",
)  # fmt: skip
SIGNALS = {"kill": signal.SIGKILL, "end": signal.SIGTERM}


class Way:
    """The bridge, the program in ROS 2, and what can be done to each."""

    def __init__(self, bridge, start_ros2):
        self.bridge, self._start = bridge, lambda: start_ros2(CLASS)
        self.program = self._start()

    def drives(self, robot):
        """Whether the robot does; the program is started again if it has ended."""
        if self.program.ended:
            self.program = self._start()
        return self.bridge.is_up() and moves(robot)

    def send(self, part, number):
        pid = self.program.pid if part == PROGRAM else self.bridge.process(part)
        with contextlib.suppress(ProcessLookupError):
            if pid:
                os.kill(pid, number)

    def hit(self, fault, draw):
        """Return how long [s] a part was lost; 0: it was not, or not long enough to be seen."""
        kind, part = fault.split(":")
        if kind == "strange":
            speak(part, draw)
            return 0.0
        if kind == "stop":
            lasts_s = draw.uniform(0.02, 2 * REST_S)
            self.send(part, signal.SIGSTOP)
            time.sleep(lasts_s)
            self.send(part, signal.SIGCONT)
            return lasts_s
        self.send(part, SIGNALS[kind])
        return REST_S


def speak(part, draw):
    """Publish on a topic of the bridge, as another program, what is useless or too much."""
    kind = Twist if part == "chatter" else Joy
    publisher = rospy.Publisher(f"/{part}", kind, queue_size=1)
    message = kind()
    if kind is Joy:
        message.axes = [0.0] * draw.choice([0, 1, 3, LONG])
        message.header.frame_id = draw.choice(["", "\u00e4 {} %s \\ \n <b>", "x" * 10_000])
    for _ in range(draw.randrange(1, 5)):
        publisher.publish(message)
        time.sleep(0.05)
    publisher.unregister()


def turned(robot, since_s, until_s):
    """{when: whether the wheels turned} between two times."""
    return {
        when: abs(message.twist.twist.linear.x) > 0.01
        for when, _, message in list(robot.heard)
        if since_s < when <= until_s
    }


def trial(seed, way, robot):
    """A drive with one or two faults, then a release. Raises AssertionError with the seed."""
    draw = random.Random(seed)
    faults = draw.choices(FAULTS, k=draw.choice((1, 2)))
    said = f"seed {seed}: {' + '.join(faults)}"
    del robot.heard[:-1]
    stick, lost = Stick().begin(), []
    try:
        wait_for(lambda: way.drives(robot), f"a robot that drives ({said})")
        for fault in faults:
            time.sleep(draw.uniform(0.0, 0.4))
            began_s = time.monotonic()
            if way.hit(fault, draw) >= REST_S:
                lost.append(began_s)
        time.sleep(draw.uniform(0.0, 2.0))
    finally:
        released_s = stick.end()
        stick._publisher.unregister()
    rests_s = released_s + REST_S + OLD_S
    # A second in which what waited somewhere would move it.
    wait_for(lambda: robot.heard[-1][0] > rests_s + 1.0, f"odometry ({said})")
    for began_s in lost:
        rests = turned(robot, began_s, began_s + REST_S)
        assert not all(rests.values()), f"{said}: (d) it drove on for {REST_S} s"
    late = turned(robot, rests_s, time.monotonic())
    assert late and not any(late.values()), f"{said}: (f) it moved after the release"
    return said


def test_random_faults(bridge, start_ros2, robot, request):
    option = request.config.getoption
    way = Way(bridge(), start_ros2)
    for seed in range(option("--seed"), option("--seed") + option("--trials")):
        try:
            print(trial(seed, way, robot), flush=True)
        except AssertionError as error:
            raise AssertionError(f"{error}\n{way.bridge.output}\n{way.program.output}") from None
    stick = Stick().begin()
    wait_for(lambda: way.drives(robot), "a robot that drives after all that")
    stick.end()
    assert "Traceback" not in way.bridge.output, way.bridge.output
