"""Which words of the command line are passed to rospy."""

import pytest

pytest.importorskip("rospy", reason="no ROS for this Python: ./tutorial setup")

from node_kit.start import _without_parameters


def test_remaps_and_special_names_stay_and_parameters_go():
    arguments = ["node.py", "__name:=ada", "cmd_vel:=other", "_rate:=5", "_robots/ada:=[0]", "_x"]
    assert _without_parameters(arguments) == ["node.py", "__name:=ada", "cmd_vel:=other", "_x"]
