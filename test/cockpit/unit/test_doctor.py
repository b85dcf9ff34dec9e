"""The doctor's lines on pages, and who may run it."""

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
    source, driver, viewer = doctor.Doctor(), page(), page(role="viewer")

    def verdict(who, now):
        source.on_doctor(who[0], now)
        sent = wait_for(lambda: [m for m in look(source, who)[0] if not m["running"]], "its end")
        return [(line["level"], line["subject"]) for line in sent[0]["lines"]]

    assert doctor_line("unknown  joystick  none\n")["level"] == "note"
    for _ in range(2):
        assert verdict(driver, 0.0) == [("wrong", "doctor")]
    assert len(runs) == 2
    ended = time.monotonic()
    assert verdict(viewer, ended) == [("wrong", "doctor")] and len(runs) == 2  # the last result
    assert verdict(viewer, ended + doctor.FRESH_S + 1.0) and len(runs) == 3
