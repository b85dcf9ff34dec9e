"""What of the command line rospy is shown."""

import pytest

pytest.importorskip("rospy", reason="no ROS for this Python: ./tutorial setup")

from node_kit.careful_connections import sender_of
from node_kit.start import _without_parameters


def test_remaps_and_special_names_stay_and_parameters_go():
    arguments = ["node.py", "__name:=ada", "cmd_vel:=other", "_rate:=5", "_robots/ada:=[0]", "_x"]
    assert _without_parameters(arguments) == ["node.py", "__name:=ada", "cmd_vel:=other", "_x"]


@pytest.mark.parametrize(("header", "sender"), [({"callerid": "/ada"}, "/ada"), ({}, "")])
def test_a_sender_that_gave_no_name_has_none(header, sender):
    class Message:
        _connection_header = header

    assert sender_of(Message()) == sender
