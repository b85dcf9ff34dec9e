"""joy_node over a FIFO: what it publishes for events, recordings and scripts, and its cost."""

import math
import os
import re
import time
from pathlib import Path

import rosbag
import rospkg
import rospy
from sensor_msgs.msg import Joy

from gamepad.driver.driver import SHORTEST_SILENCE_S
from gamepad.gamepads import F710_D, F710_X
from gamepad.io.pads import StreamPad
from gamepad.js_event import FULL
from gamepad.virtual.controls import Controls, positions
from joy_to_twist.states import State
from tutorial_testing.claims import claim
from tutorial_testing.keys import LAUNCH, DiagnosedRobot
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import BUSY_S, Stopwatch, wait_for

PACKAGE = Path(rospkg.RosPack().get_path("gamepad"))
VIRTUAL = node_path("gamepad", "virtual_joystick")
LB, A = frozenset(["LB"]), frozenset(["A"])
REST, PRESSED, HELD = (positions(F710_X, Controls(held=held)) for held in ((), A, LB))
PUSHED = positions(F710_X, Controls(left_stick=(0.0, 1.0), triggers=(0.0, 1.0), held=LB))
STILL_S = 5.0
# Measured: 26. The driver alone wakes 10 times, to check whether it must exit.
WAKINGS_A_SECOND = 50
CORNERS = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)]  # [m], in their order
NEAR_M = 0.25  # on a busy machine each move may be some hundredths of a second off


@claim(
    "A script of moves drives a square; a recording arrives through a FIFO as it was made; a "
    "mistake in a script is one line"
)
class DriverTest(RosTest):
    def setUp(self):
        self.device = str(self.folder() / "js0")
        self.joys = []
        self._subscriber = self.hear("joy", Joy, self.joys.append)

    def plug_in(self):
        """Create the device, and wait for its reader; return the gamepad, at rest."""
        pad = self.enter(StreamPad(F710_X, self.device))
        pad.gives_signs = False  # as the kernel's devices
        wait_for(lambda: pad.show(REST) or pad.connected, "reader of the device")
        return pad

    def start_driver(self, *parameters):
        """Start joy_node, which reads the FIFO; parameters as ~name:=value without the ~."""
        if rospy.has_param("/joy_node"):
            rospy.delete_param("/joy_node")  # left by the previous test: the master keeps them
        given = [f"_{parameter}" for parameter in (f"dev:={self.device}", *parameters)]
        return self.start(node_path("gamepad", "joy_node"), *given)

    @property
    def last(self):
        """(axes, buttons held) of the newest message, or None."""
        if not self.joys:
            return None
        joy = self.joys[-1]
        return tuple(joy.axes), [n for n, held in enumerate(joy.buttons) if held]

    def test_a_loss_gives_neutral_at_once_then_silence_and_it_comes_back_by_itself(self):
        program = self.start_driver()
        wait_for(lambda: "No joystick at" in program.output, "line on the missing device")
        wait_for(self._subscriber.get_num_connections, "connection")
        pad = self.plug_in()  # in X mode, where axes 2 and 5 are triggers
        pad.show(PUSHED)
        wait_for(lambda: self.last and self.last[1] == [4], "stick pushed with the dead-man held")
        watch, lost = Stopwatch(), time.time()
        os.unlink(self.device)
        pad.show(None)
        neutral = ((0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0), [])
        wait_for(lambda: self.last == neutral, "neutral message")
        after = [joy for joy in self.joys if not joy.buttons[4] and joy.axes[5] == 1.0]
        self.assertEqual((len(after), after[0].header.frame_id), (1, self.device))
        late_s = after[0].header.stamp.to_sec() - lost - watch.lost_s
        self.assertLess(late_s, 0.1 + BUSY_S)
        wait_for(lambda: "No joystick at" in program.output.partition("Lost")[2], "search")
        count = len(self.joys)
        self.assertGreaterEqual(time.time() - lost, SHORTEST_SILENCE_S)

        watch = Stopwatch()
        pad = self.plug_in()
        self.assertLess(watch.took_s, 1.0 + BUSY_S)
        # Silent until it is touched: the state at opening may be wrong.
        pad.show(HELD)
        wait_for(lambda: len(self.joys) > count, "message")
        self.assertEqual(self.joys[count].buttons[4], 1)

    @claim("A burst is coalesced, and a still stick hardly wakes the driver")
    def test_a_still_stick_hardly_wakes_the_driver(self):
        program = self.start_driver("autorepeat_rate:=0")
        pad = self.plug_in()
        # The driver repeats nothing, and may not be connected to its subscriber yet.
        wait_for(lambda: pad.show(PRESSED) or pad.show(REST) or self.joys, "first message")
        before = wakings(program.pid)
        time.sleep(STILL_S)  # what is measured
        self.assertLess(wakings(program.pid) - before, WAKINGS_A_SECOND * STILL_S)

    def test_a_recording_arrives_in_the_steps_of_the_gamepad(self):
        path, axis = PACKAGE / "bag/joy.bag", F710_D.axes[1]
        with rosbag.Bag(str(path)) as bag:
            steps = {-axis.js_value(axis.raw(joy.axes[1])) for _, joy, _ in bag.read_messages()}
        self.start(VIRTUAL, "--stream", self.device, "--bag", str(path))
        self.start_driver("deadzone:=0.0")
        wait_for(lambda: len({joy.axes[1] for joy in self.joys}) > 30, "moving stick")
        trembled = {step - (step > 0) + (step < 0) for step in steps}
        self.assertLessEqual({round(joy.axes[1] * FULL) for joy in self.joys}, steps | trembled)
        self.assertTrue(any(joy.buttons[4] for joy in self.joys))

    def test_a_mistake_in_what_it_plays_is_one_line(self):
        script = self.folder() / "moves.yaml"
        script.write_text("7", encoding="utf-8")
        for line, *given in (
            ("moves.yaml: it has no list of moves", "--script", str(script)),
            ("exists and is no FIFO", "--stream", str(script)),
        ):
            self.check_mistake(Program(VIRTUAL, "--stream", self.device, *given), line)
        self.assertEqual(script.read_text(encoding="utf-8"), "7")

    def test_a_script_of_moves_drives_a_square(self):
        robot, device = self.enter(DiagnosedRobot()), self.device
        self.start(*LAUNCH, f"joy_dev:={device}")
        # The script begins with its reader, and the robot must be ready then.
        robot.wait_for_state(State.WAITING.value)
        script = str(PACKAGE / "config/virtual_joystick/square.yaml")
        self.check_end(self.start(VIRTUAL, "--stream", device, "--script", script))
        passed = iter(robot.odometry)
        for corner in CORNERS:
            near = any(math.dist((at.x, at.y), corner) < NEAR_M for at in passed)
            self.assertTrue(near, f"not near {corner} after those before")
        self.assertFalse(robot.now.moves)
        self.assertLess(math.dist(robot.now.pose[:2], CORNERS[-1]), NEAR_M)


def wakings(pid):
    """Return how often the threads of a process have waited, which does not depend on the load."""
    states = [path.read_text() for path in Path(f"/proc/{pid}/task").glob("*/status")]
    return sum(int(re.search(r"^voluntary_ctxt_switches:\s*(\d+)", s, re.M)[1]) for s in states)
