"""The entries of a Kobuki in /diagnostics, in the words of kobuki_node's diagnostics.cpp."""

from diagnostic_msgs.msg import DiagnosticStatus

from kobuki_driver.robot.diagnostics import entries
from kobuki_protocol.battery import Battery
from kobuki_protocol.feedback import Cliff, Core, Current, Feedback, Inertia, Inputs
from tutorial_testing.claims import claim

pytestmark = claim("/diagnostics has kobuki_node's entries")
OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


def seen(feedback, is_online=True, has_power=True):
    made = entries(feedback, Battery.of(feedback.core), is_online, has_power)
    return {entry.name: (entry.level, entry.text) for entry in made}


def test_a_robot_that_is_well():
    inputs = Inputs(digital=5, analog=(1, 2, 3, 4))
    feedback = Feedback(core=Core(battery=150), inertia=Inertia(9000), inputs=inputs)
    assert seen(feedback) == {
        "Battery": (OK, "Healthy"),
        "Watchdog": (OK, "Alive"),
        "Wall Sensor": (OK, "All right"),
        "Cliff Sensor": (OK, "All right"),
        "Wheel Drop": (OK, "All right"),
        "Motor Current": (OK, "All right"),
        "Motor State": (OK, "Motors Enabled"),
        "Gyro Sensor": (OK, "Heading: 90.00 degrees"),
        "Digital Input": (OK, "[0, 1, 0, 1]"),
        "Analog Input": (OK, "[1, 2, 3, 4]"),
    }


def test_a_robot_that_is_not():
    core = Core(bumper=1, cliff=2, wheel_drop=1, battery=130)
    assert seen(Feedback(core=core, current=Current(7, 0)), False, False) == {
        **seen(Feedback()),
        "Battery": (WARN, "Dangerous"),
        "Watchdog": (ERROR, "No Signal"),
        "Wall Sensor": (WARN, "Wall Hit!"),
        "Cliff Sensor": (WARN, "Cliff Detected!"),
        "Wheel Drop": (WARN, "Wheel Drop!"),
        "Motor Current": (WARN, "Is robot stalled? Motors current is very high"),
        "Motor State": (WARN, "Motors Disabled"),
    }


def test_sides_and_charger_are_values():
    core = Core(bumper=4, cliff=1, charger=22, battery=165)
    feedback = Feedback(core=core, cliff=Cliff(0, 1500, 1600))
    values = {e.name: e.values for e in entries(feedback, Battery.of(core), True, True)}
    assert values["Wall Sensor"] == {"Left": "YES", "Center": "NO", "Right": "NO"}
    assert values["Cliff Sensor"]["Right"] == "Reading: 0  Cliff: YES"
    assert values["Battery"]["Charging State"] == "Full Charging"
    assert values["Battery"]["Source"] == "Adapter"
    assert values["Battery"]["Percent"] == "100.0"
