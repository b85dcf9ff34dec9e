"""Recordings survive the conversion to JSON and back."""

import importlib
import json

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from courses.handout.driving.bag import Bag
from courses.handout.driving.joy2twist_run import Joy2TwistRun
from courses.handout.gamepad.record import Stick
from courses.handout.launch_runs.record import LaunchRun
from courses.handout.node_class.record import Alone, Endings
from courses.handout.remapping.record import Remap
from courses.handout.simulated_robot.record import Follow
from courses.handout.talker_listener.record import Talk
from courses.handout.world import record as s7
from tutorial_check.data import recorders
from tutorial_check.data.json_data import as_json, from_json

KINDS = [Talk, Bag, Follow, Stick, Joy2TwistRun, LaunchRun, Remap, Alone, Endings]
KINDS += [s7.Presses, s7.RoomDrive]
st.register_type_strategy(float, st.floats(allow_nan=False))


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: f"{kind.__module__}.{kind.__name__}")
@settings(max_examples=20, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_a_recording_comes_back_from_json(kind, data):
    recording = data.draw(st.from_type(kind))
    assert from_json(kind, json.loads(json.dumps(as_json(recording)))) == recording


@pytest.mark.parametrize("text", ["[]", "{}", '{"drives": true, "x": 1}', "null"])
def test_another_text_is_no_recording(text):
    with pytest.raises(ValueError, match="no Stick"):
        from_json(Stick, json.loads(text))


@pytest.mark.parametrize("word", ["BUILT", "OWN_BUILT", "INSTALLED", "LAUNCH_FILES"])
def test_a_name_of_a_recorder_leads_to_it(word):
    named = getattr(recorders, word)
    module, _, name = named.name.partition(":")
    assert recorders.name_of(getattr(importlib.import_module(module), name)) == named
