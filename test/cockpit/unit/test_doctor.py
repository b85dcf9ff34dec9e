"""The doctor's lines on pages, and who may have it run."""

import time

from cockpit_server.ros.tabs import doctor
from cockpit_server.tabs.logs import doctor_line
from tutorial_testing.claims import claim
from tutorial_testing.session_room import look, page
from tutorial_testing.waiting import wait_for


@claim("The doctor runs once at a time; viewers get what is known")
def test_doctor_that_cannot_run_is_reported_and_runs_again_but_for_viewers_not_at_once(monkeypatch):
    runs = []
    monkeypatch.setattr(doctor.rospkg, "RosPack", lambda: runs.append(1) or [].pop())
    one, driver, viewer = doctor.Doctor(), page(), page(role="viewer")

    def found(who, now):
        one.on_doctor(who[0], now)
        told = wait_for(lambda: [m for m in look(one, who)[0] if not m["running"]], "its end")
        return [(line["level"], line["subject"]) for line in told[0]["lines"]]

    assert doctor_line("unknown  joystick  none\n")["level"] == "note"
    for _ in range(2):
        assert found(driver, 0.0) == [("wrong", "doctor")]
    assert len(runs) == 2
    ended = time.monotonic()
    assert found(viewer, ended) == [("wrong", "doctor")] and len(runs) == 2  # what is known
    assert found(viewer, ended + doctor.FRESH_S + 1.0) and len(runs) == 3
