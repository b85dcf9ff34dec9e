"""The doctor's row about a real Kobuki."""

import pytest
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from kobuki_driver.link import port_advice
from kobuki_driver.link.sample import Sample, Sampler
from kobuki_driver.robot.diagnostics import entries
from kobuki_protocol import robot_packets
from kobuki_protocol.battery import Battery
from kobuki_protocol.feedback import Core, Feedback
from kobuki_protocol.identity import FirmwareVersion
from tutorial_testing.claims import claim
from tutorial_tools.doctor.facts import Facts
from tutorial_tools.doctor.judgement import judge
from tutorial_tools.ros.doctor.messages import base

pytestmark = claim(
    "The doctor's row Kobuki: port, permission, rule, latency timer, packets, firmware, battery, "
    "charger; or what a driver that runs says"
)
WELL = {
    "latency_ms": 1, "packets": 50, "count": 4000,
    "firmware": FirmwareVersion(0, 2, 1), "battery": Battery(16.4),
}  # fmt: skip
USUAL = "/dev/kobuki"


def rows(*samples):
    findings = judge(Facts(kobukis=list(samples)))
    return [(line.level, line.seen, line.todo) for line in findings if line.about == "Kobuki"]


def test_without_a_port_there_is_no_row():
    assert rows() == []


def test_a_robot_that_is_well_has_one_row():
    ((level, seen, _),) = rows(Sample(USUAL, **WELL))
    assert level == "ok"
    assert seen == "/dev/kobuki: 50 packets a second, firmware 1.2.0, battery 16.4 V, 97 %"


@pytest.mark.parametrize(("changes", "part"), [
    ({"complaint": port_advice.absent(USUAL, [])}, "there is no /dev/kobuki. Plug in"),
    ({"complaint": port_advice.forbidden(USUAL, "dialout", "ada", False)}, "usermod -aG"),
    ({"complaint": port_advice.taken(USUAL, "python3 (pid 7)")}, "python3 (pid 7) has"),
    ({"has_rule": False}, "no udev rule"),
    ({"latency_ms": 16}, "for up to 16 ms (latency timer)"),
    ({"packets": 0, "count": 0}, "is the Kobuki switched on?"),
    ({"packets": 0, "count": 99}, "99 bytes came from /dev/kobuki"),
    ({"packets": 30}, "30 packets a second of 50"),
    ({"damaged": 3}, "3 damaged"),
    ({"firmware": FirmwareVersion(0, 0, 2)}, "firmware 2.0.0 is not driven"),
    ({"battery": Battery(13.0)}, "battery 13.0 V"),
])  # fmt: skip
def test_each_fault_is_one_row(changes, part):
    bad = [(seen, todo) for level, seen, todo in rows(Sample(USUAL, **{**WELL, **changes}))
           if level == "wrong"]  # fmt: skip
    assert len(bad) == 1
    assert part in bad[0][0]
    assert "aiting for it" not in bad[0][0]


def test_the_charger_is_named():
    ((_, seen, _),) = rows(Sample(USUAL, **{**WELL, "battery": Battery(16.0, 6)}))
    assert seen.endswith("charging (dock)")
    ((_, seen, _),) = rows(Sample(USUAL, **{**WELL, "battery": Battery(16.6, 18)}))
    assert seen.endswith("charged (adapter)")


def test_a_driver_that_runs_is_asked_in_place_of_the_port():
    taken = Sample(USUAL, complaint=port_advice.taken(USUAL, "mobile_base (pid 7)"))
    for is_alive, level, part in ((True, "ok", "healthy, 15.0 V"), (False, "wrong", "waits for a")):
        facts = Facts(kobukis=[taken], bases={"/mobile_base": (is_alive, "healthy, 15.0 V")})
        ((found, seen),) = [(f.level, f.seen) for f in judge(facts) if f.about == "Kobuki"]
        assert found == level
        assert part in seen


def test_a_driver_is_known_by_its_diagnostics():
    feedback = Feedback(core=Core(battery=150, charger=6))
    made = entries(feedback, Battery.of(feedback.core), True, True)
    said = [
        DiagnosticStatus(e.level, f"mobile_base: {e.name}", e.text, "Kobuki",
                         [KeyValue(key, str(value)) for key, value in e.values.items()])
        for e in made
    ]  # fmt: skip
    battery = "healthy, 15.0 V, full charging"
    assert base("/mobile_base", said) == ("/mobile_base", (True, battery))
    assert base("/mobile_base", []) is None


def test_bytes_are_summed_up():
    sampler = Sampler()
    packet = robot_packets.build(Core(battery=150), FirmwareVersion(4, 1, 1))
    sampler.take(packet[5:] + packet * 3)
    assert (sampler.packets, sampler.damaged) == (3, 0)
    assert str(sampler.firmware) == "1.1.4"
    assert sampler.battery == Battery(15.0)
