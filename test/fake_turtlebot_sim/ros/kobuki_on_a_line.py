"""A Kobuki on a pseudo terminal: it needs no master, and appears at any that runs."""

import os
import subprocess
import time

import rospy
from kobuki_msgs.msg import ButtonEvent
from nav_msgs.msg import Odometry
from std_srvs.srv import Empty, SetBool

from kobuki_protocol.base_control import base_control
from kobuki_protocol.commands import GetController, IdentityRequest, Outputs
from kobuki_protocol.feedback import Core
from kobuki_protocol.identity import Controller, FirmwareVersion
from node_kit.ros.graph.ros_api import call
from tutorial_testing.claims import claim
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program, environment, free_port, suspended
from tutorial_testing.rostests import RosTest
from tutorial_testing.serial_kobuki import Driver, SerialKobuki
from tutorial_testing.waiting import LONGEST_S, wait_for

NODE = "/serial_kobuki"


def call_service(name, kind, *values):
    rospy.wait_for_service(f"{NODE}/{name}")
    return rospy.ServiceProxy(f"{NODE}/{name}", kind)(*values)


@claim(
    "serial_kobuki needs no master and follows each that comes; its link, cable and switch are a "
    "robot's"
)
class SerialKobukiTest(RosTest):
    def test_1_it_needs_no_master_and_is_seen_by_each_that_comes(self):
        port = free_port()
        uri = f"http://localhost:{port}"
        device = self.enter(SerialKobuki(ROS_MASTER_URI=uri))
        driver = self.enter(Driver(device.port))
        for _ in range(2):
            self.assertEqual(driver.wait_for(Core).battery, 164)  # without a master
            with Program("rosmaster", "--core", "-p", str(port)):
                wait_for(lambda: call(uri, "getPid")[1], "master")
                command = "rostopic", "echo", "-n1", "/base_pose_ground_truth/pose/pose/position"
                given = {"env": environment(ROS_MASTER_URI=uri), "timeout": LONGEST_S}
                self.assertIn("x: 0.0", subprocess.check_output(command, text=True, **given))

    def test_2_it_drives_and_answers_and_prints_what_it_is_asked_for(self):
        device = self.enter(SerialKobuki("_world:=room", "_other_firmware:=1.1.4"))
        truths = self.record("base_pose_ground_truth", Odometry)
        driver = self.enter(Driver(device.port))
        driver.send(IdentityRequest())
        self.assertEqual(str(driver.wait_for(FirmwareVersion)), "1.1.4")
        driver.send(GetController())
        self.assertEqual(driver.wait_for(Controller), Controller())
        driver.send(Outputs().with_led(1, 3))
        device.wait_for_line("LED 1: red")
        wait_for(lambda: truths, "truth")
        hit = driver.drive(0.7, 0.0, lambda core: core.bumper)
        self.assertEqual(hit.bumper, 2)
        place = wait_for(lambda: truths[-1], "truth").pose.pose.position
        self.assertAlmostEqual(place.x, 4.0 - 0.178, delta=1e-6)
        self.assertAlmostEqual(hit.left_encoder * 8.529e-5, place.x, delta=1e-3)
        device.wait_for_line("no base control for 0.6 s: the wheels stop")

    def test_3_buttons_switch_and_cable_are_those_of_a_robot(self):
        device = self.enter(SerialKobuki())
        press = self.connected("mobile_base/press", ButtonEvent)
        with Driver(device.port) as driver:
            press.publish(button=1, state=ButtonEvent.PRESSED)
            driver.wait_for(Core, lambda core: core.buttons == 2)
            call_service("charge", SetBool, True)
            driver.wait_for(Core, lambda core: core.charger == 6)
            driven = driver.drive(0.3, 0.0, lambda core: core.left_encoder > 500)
            call_service("reboot", Empty)
            back = driver.wait_for(Core, lambda core: core.time_stamp < driven.time_stamp)
            self.assertEqual((back.left_encoder, back.right_encoder), (0, 0))
            self.assertEqual(call_service("plug_in", SetBool, False).message, "the cable is out")
            with self.assertRaises(EOFError):
                wait_for(lambda: driver.read() and False, "end of the line")
        self.assertFalse(os.path.lexists(device.port))
        os.mkdir(device.port)  # a folder in the place of the link
        call_service("plug_in", SetBool, True)
        device.wait_for_line("File exists")
        os.rmdir(device.port)
        call_service("plug_in", SetBool, True)
        wait_for(lambda: os.path.exists(device.port), "cable")
        self.enter(Driver(device.port)).wait_for(Core)

    def test_4_it_misbehaves_when_it_is_told_to(self):
        device = self.enter(SerialKobuki("_reboot_after:=1", "_unplug_after:=4"))
        with Driver(device.port) as driver:
            driver.wait_for(Core, lambda core: core.time_stamp > 500)
            driver.wait_for(Core, lambda core: core.time_stamp < 500)
            with self.assertRaises(EOFError):
                wait_for(lambda: driver.read() and False, "end of the line")
        wait_for(lambda: os.path.exists(device.port), "cable")
        self.enter(Driver(device.port)).wait_for(Core)

    def test_5_what_was_sent_while_it_was_suspended_moves_nothing(self):
        device = self.enter(SerialKobuki())
        driver = self.enter(Driver(device.port))
        before = driver.wait_for(Core)
        with suspended([device.program.pid]):
            driver.read()
            driver.send(*[base_control(0.3, 0.0)] * 20)
            time.sleep(1.0)
        later = driver.wait_for(Core, lambda core: core.time_stamp - before.time_stamp > 1500)
        self.assertEqual(later.left_encoder, before.left_encoder)

    def test_6_however_it_is_ended_the_link_is_gone(self):
        end = lambda device: device.program.interrupt()  # noqa: E731
        kill = lambda _: self.start("rosnode", "kill", NODE)  # noqa: E731
        for how in (end, kill):
            with SerialKobuki() as device:
                rospy.wait_for_service(f"{NODE}/reset")
                how(device)
                self.check_end(device.program)
                self.assertFalse(os.path.lexists(device.port))

    def test_7_a_mistake_is_one_line(self):
        program = node_path("fake_turtlebot_sim", "serial_kobuki")
        self.check_mistake(Program(program, "_stall:=10"), "~stall: 10: must be a number from 0 to")
        self.check_mistake(Program(program, "_link:=/proc"), "~link: '/proc': File exists")
