"""turtlesim's services exist before the node has loaded rospy, for a rosservice beside it."""

import sys
from io import BytesIO
from pathlib import Path
from urllib.parse import urlsplit

import rosgraph
import rospy
from rosgraph.network import read_ros_handshake_header, write_ros_handshake_header
from turtlesim.srv import Spawn

from simulated_turtles.services import AT_THE_START
from tutorial_testing.claims import claim
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

# Runs a program that cannot import rospy until a file exists.
GATED = """
import pathlib, runpy, sys, time

class Gate:
    def find_spec(self, name, path=None, target=None):
        while name == "rospy" and not pathlib.Path(gate).exists():
            time.sleep(0.01)

_, gate, *sys.argv = sys.argv
sys.meta_path.insert(0, Gate())
runpy.run_path(sys.argv[0], run_name="__main__")
"""
BESIDE = """
<launch>
  <arg name="ns"/>
  <group ns="$(arg ns)">
    <node pkg="turtlesim" type="turtlesim_node" name="sim"/>
    <node pkg="rosservice" type="rosservice" name="second" args="call spawn 3.0 3.0 0.0 second"/>
  </group>
</launch>
"""
READY_S = 0.5  # Processor time; upstream's node took 0.31 s.
TIMES = 10


def processor_s(pid):
    """Return the processor time [s] that the threads of a process have had."""
    times = (path.read_text() for path in Path(f"/proc/{pid}/task").glob("*/schedstat"))
    return sum(int(text.split()[0]) for text in times) / 1e9


@claim(
    "turtlesim answers /spawn half a second after its start, and `rosservice call` beside it in a "
    "launch file"
)
class AtOnceTest(RosTest):
    def services(self):
        _, _, services = rosgraph.Master("/test").getSystemState()
        return {name for name, _ in services if name.startswith("/late/")}

    def start_gated(self):
        """Start a turtlesim that cannot load rospy yet; return it and what opens its way."""
        gate, script = self.folder() / "gate", node_path("turtlesim", "turtlesim_node")
        node = self.start(sys.executable, "-c", GATED, str(gate), script, "__ns:=late")
        wait_for(lambda: {f"/late/{name}" for name in AT_THE_START} <= self.services(), "services")
        return node, gate.touch

    def test_a_caller_that_comes_before_ros_is_loaded_gets_its_answer_after_it(self):
        node, open_gate = self.start_gated()
        address = urlsplit(rosgraph.Master("/test").lookupService("/late/spawn"))
        # As rosservice asks for the type of a service.
        request = {"probe": "1", "md5sum": "*", "callerid": "/test", "service": "/late/spawn"}
        with rosgraph.network.socket.create_connection((address.hostname, address.port)) as caller:
            write_ros_handshake_header(caller, request)
            open_gate()
            answer = read_ros_handshake_header(caller, BytesIO(), 2048)
        self.assertEqual(answer["type"], "turtlesim/Spawn")
        self.assertEqual(rospy.ServiceProxy("/late/spawn", Spawn)(1.0, 1.0, 0.0, "b").name, "b")
        self.end(node)
        self.assertEqual(self.services(), set())

    def test_ctrl_c_before_ros_is_loaded_leaves_nothing_registered(self):
        node, _ = self.start_gated()
        node.interrupt()
        node.wait()
        self.assertEqual((node.output, self.services()), ("", set()))

    def test_spawn_answers_half_a_second_after_the_start(self):
        node = self.start(node_path("turtlesim", "turtlesim_node"), "__ns:=measured")
        rospy.wait_for_service("/measured/spawn")
        rospy.ServiceProxy("/measured/spawn", Spawn)(1.0, 1.0, 0.0, "b")
        self.assertLess(processor_s(node.pid), READY_S)

    def test_a_launch_file_may_call_spawn_beside_it(self):
        path = self.folder() / "beside.launch"
        path.write_text(BESIDE)
        for _ in range(2):  # a busy machine
            self.start(sys.executable, "-c", "while True: pass")
        for number in range(TIMES):
            pose = f"/beside{number}/second/pose"
            with Program("roslaunch", str(path), f"ns:=beside{number}"):
                wait_for(lambda pose=pose: pose in dict(rospy.get_published_topics()), pose, 60)
