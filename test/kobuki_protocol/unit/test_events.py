"""Events and battery of a Kobuki, worked out by hand from kobuki_driver's event_manager.cpp."""

from dataclasses import replace

import pytest
from kobuki_msgs.msg import (
    BumperEvent,
    ButtonEvent,
    CliffEvent,
    DigitalInputEvent,
    PowerSystemEvent,
    WheelDropEvent,
)

from kobuki_protocol.battery import Battery, Level, Limits
from kobuki_protocol.events import events
from kobuki_protocol.feedback import Cliff, Core, Feedback, Inputs
from tutorial_testing.claims import claim

pytestmark = claim("Events and battery levels are those of a Kobuki's own driver")
FULL = Feedback(core=Core(battery=164), cliff=Cliff(1, 2, 3))


def changed(**values):
    return replace(FULL, core=replace(FULL.core, **values))


@pytest.mark.parametrize(("now", "event"), [
    (changed(bumper=4), ("bumper", BumperEvent(BumperEvent.LEFT, BumperEvent.PRESSED))),
    (changed(bumper=1), ("bumper", BumperEvent(BumperEvent.RIGHT, BumperEvent.PRESSED))),
    (changed(cliff=2), ("cliff", CliffEvent(CliffEvent.CENTER, CliffEvent.CLIFF, 2))),
    (changed(cliff=4), ("cliff", CliffEvent(CliffEvent.LEFT, CliffEvent.CLIFF, 3))),
    (changed(wheel_drop=1), ("wheel_drop", WheelDropEvent(WheelDropEvent.RIGHT, 1))),
    (changed(wheel_drop=2), ("wheel_drop", WheelDropEvent(WheelDropEvent.LEFT, 1))),
    (changed(buttons=4), ("button", ButtonEvent(ButtonEvent.Button2, ButtonEvent.PRESSED))),
    (replace(FULL, inputs=Inputs(2)),
     ("digital_input", DigitalInputEvent([False, True, False, False]))),
])  # fmt: skip
def test_each_change_is_one_event(now, event):
    assert events(FULL, now) == [event]
    ((topic, back),) = events(now, FULL)
    assert topic == event[0]
    assert back != event[1]
    assert events(now, now) == []


def test_what_changes_at_once_are_several_events():
    made = events(Feedback(), changed(bumper=7, buttons=3, cliff=1, wheel_drop=3))
    assert [topic for topic, _ in made] == (
        ["button"] * 2 + ["bumper"] * 3 + ["cliff"] + ["wheel_drop"] * 2
    )


@pytest.mark.parametrize(("before", "now", "numbers"), [
    ((0, 150), (22, 150), [PowerSystemEvent.PLUGGED_TO_ADAPTER]),
    ((0, 150), (6, 150), [PowerSystemEvent.PLUGGED_TO_DOCKBASE]),
    ((6, 164), (2, 164), [PowerSystemEvent.CHARGE_COMPLETED]),
    ((22, 164), (18, 164), [PowerSystemEvent.CHARGE_COMPLETED]),
    ((18, 164), (0, 164), [PowerSystemEvent.UNPLUGGED]),
    ((0, 141), (0, 140), [PowerSystemEvent.BATTERY_LOW]),
    ((0, 133), (0, 132), [PowerSystemEvent.BATTERY_CRITICAL]),
    ((0, 141), (0, 131), [PowerSystemEvent.BATTERY_CRITICAL]),
    ((0, 140), (0, 141), []),  # upwards: nothing
    ((0, 160), (0, 150), []),  # no other level
    ((2, 164), (0, 163), [PowerSystemEvent.UNPLUGGED]),
])  # fmt: skip
def test_power(before, now, numbers):
    pair = [changed(charger=charger, battery=volts) for charger, volts in (before, now)]
    assert events(*pair) == [("power_system", PowerSystemEvent(number)) for number in numbers]


def test_the_limits_are_parameters():
    pair = changed(battery=151), changed(battery=149)
    low = PowerSystemEvent(PowerSystemEvent.BATTERY_LOW)
    assert events(*pair, limits=Limits(low=15.0)) == [("power_system", low)]


@pytest.mark.parametrize(("battery", "level", "percent", "source"), [
    (Battery(16.5), Level.HEALTHY, 100.0, "None"),
    (Battery(13.2), Level.DANGEROUS, 5.0, "None"),
    (Battery(13.3), Level.LOW, 7.9, "None"),
    (Battery(14.1, 22), Level.HEALTHY, 30.9, "Adapter"),
    (Battery(16.7, 2), Level.MAXIMUM, 100.0, "Dock"),
    (Battery(5.0), Level.DANGEROUS, 0.0, "None"),
])  # fmt: skip
def test_a_battery(battery, level, percent, source):
    assert (battery.level, battery.source) == (level, source)
    assert battery.percent == pytest.approx(percent, abs=0.1)
