"""Recordings that a launch file refuses."""

import pytest

from gamepad.ros.bags import check_recording
from tutorial_testing.processes import REPOSITORY

JOY_BAG = REPOSITORY / "common/gamepad/bag/joy.bag"


def test_a_recording_that_is_damaged_is_one_line_of_the_guard(tmp_path):
    bag, preset = tmp_path / "joy.bag", JOY_BAG.parents[3] / "joy2twist" / "config" / "f710_d.yaml"
    whole = JOY_BAG.read_bytes()
    bag.write_bytes(whole[:20_000] + b"\xff" * 3000 + whole[23_000:])
    with pytest.raises(ValueError, match=r"joy\.bag: cannot be read: Invalid data[^\n]*\Z"):
        check_recording(str(bag), str(preset))
