"""The MD5 sums that ROS 1 compares are those of a real Kobuki and of turtlesim."""

import pytest
from roslib.message import get_message_class, get_service_class

from tutorial_testing.claims import claim

# getMD5() of the code that rosserial generated from the released package, found in several public
# repositories (verlab/hero_common has all, in firmware/libraries/ros_lib/kobuki_msgs).
KOBUKI = {
    "AutoDockingAction": "44be114f3afc06365a090db0a5e982b5",
    "BumperEvent": "ffe360cd50f14f9251d9844083e72ac5",
    "ButtonEvent": "49eca512765dbdec759a79083ffcec8d",
    "CliffEvent": "c5b106efbb1427a94f517c5e05f06295",
    "ControllerInfo": "46af38e72f0640f41ed22174d43a2550",
    "DigitalInputEvent": "93da823c8b121f8a3940ef3830c58e44",
    "DigitalOutput": "1e97cd7f196a0270516b506e8bf29ca2",
    "DockInfraRed": "a3d77f7d15e50579473dcc24e9b97b34",
    "ExternalPower": "95149d524971a4c6d19e64c827307194",
    "KeyboardInput": "9288b95cb32b48719d84d696be253401",
    "Led": "4391183b0cf05f8f25d04220401b9f43",
    "MotorPower": "8f77c0161e0f2021493136bb5f3f0e51",
    "PowerSystemEvent": "f6464657d6c911b00c7bc7b43a154bf8",
    "RobotStateEvent": "c6eccd4cb1f95df95635b56d6226ea32",
    "ScanAngle": "06e2c839dc5c7f5c13ac09a8b4ff0a6a",
    "SensorState": "430a4bfd78449c8740bfef32b26613a6",
    "Sound": "dfeab0daae67749c426c1db741a4f420",
    "VersionInfo": "3dc0ce6edd49be1fc86730f4a4a21861",
    "WheelDropEvent": "e102837d89384d67669a0df86b63f33b",
}
# From `rosmsg md5` with ros/ros_tutorials of Noetic.
TURTLESIM = {
    "Pose": "863b248d5016ca62ea2e895ae5265cf9",
    "Color": "353891e354491c51aabe32df673fb446",
    "Spawn": "0b2d2e872a8e2887d5ed626f2bf2c561",
    "Kill": "c1f3d28f1b044c871e6eff2e9fc3c667",
    "SetPen": "9f452acce566bf0c0954594f69a8e41b",
    "TeleportAbsolute": "a130bc60ee6513855dc62ea83fcc5b20",
    "TeleportRelative": "9d5c2dcd348ac8f76ce2a4307bd63a13",
}
REAL = {f"kobuki_msgs/{k}": v for k, v in KOBUKI.items()}
REAL.update({f"turtlesim/{k}": v for k, v in TURTLESIM.items()})


@claim("kobuki_msgs and turtlesim have the MD5 sums of the real packages")
@pytest.mark.parametrize("name", REAL)
def test_a_message_has_the_md5_sum_of_the_real_one(name):
    assert (get_message_class(name) or get_service_class(name))._md5sum == REAL[name]
