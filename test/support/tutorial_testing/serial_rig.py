"""A Kobuki's driver in place of the simulator; its robot is on a serial line.

a FIFO -> joy_node -> joy2twist -> cmd_vel_mux -> kobuki_node -> a pseudo terminal -> serial_kobuki
"""

import rospy
from std_srvs.srv import Empty, SetBool

from tutorial_testing import rig
from tutorial_testing.nodes import node_path
from tutorial_testing.serial_kobuki import SerialKobuki

BASE = "/mobile_base"


class SerialRig(rig.Rig):
    """A Rig whose odometry is the robot's ground truth, not the driver's."""

    odometry_topic, base = "base_pose_ground_truth", BASE

    def __init__(self, *device, **joy2twist):
        """device: parameters of serial_kobuki, as on a command line."""
        super().__init__(**joy2twist)
        self.robot = SerialKobuki(*device)

    def begin(self):
        self._stack.enter_context(self.robot)
        super().begin()

    def given(self, node):
        if node != BASE:
            return super().given(node)
        remaps = {"__name": BASE.lstrip("/"), f"{BASE}/commands/velocity": "/cmd_vel"}
        driver = [node_path("kobuki_node", "kobuki_node")]
        return driver, {"device_port": self.robot.port}, remaps

    def ask(self, service, *value):
        """Call a service of the robot: std_srvs/Empty, or SetBool with a value."""
        name = f"/serial_kobuki/{service}"
        rospy.wait_for_service(name)
        rospy.ServiceProxy(name, SetBool if value else Empty)(*value)
