"""What joy_node reports: when, and the rates since the last report."""

from gamepad.driver.parameters import DriverParameters
from gamepad.driver.report import SILENT_FOR, DriverReport
from tutorial_testing.gamepad_events import BUTTON, driver, events


def test_it_reports_once_in_a_period_and_a_change_at_once():
    report = DriverReport(DriverParameters(diagnostic_period=2.0), "/joy")
    assert [report.due(now) for now in (1.0, 2.9, 3.0)] == [True, False, True]
    assert report.summary() == (False, "Joystick not open.")
    report.opened("/dev/input/js1", "Pad")
    assert report.due(3.1) and report.summary() == (True, "OK")
    report.lost()
    assert report.due(3.2) and not report.due(3.3)


def test_rates_and_silence():
    report, pad = DriverReport(DriverParameters(), "/joy"), driver()
    report.opened("/dev/input/js1", "Pad")
    report.details(pad, 1, 10.0)
    pad.read(events((BUTTON, 0, 1), (BUTTON, 0, 0)), 10.5)
    report.published += 40
    details = dict(report.details(pad, 1, 12.0))
    assert (details["device"], details["device name"]) == ("/dev/input/js1", "Pad")
    assert details["recent joystick event rate (Hz)"] == 1.0
    assert details["recent publication rate (Hz)"] == 20.0
    assert details[SILENT_FOR] == "1.5"
    report.lost()
    assert dict(report.details(pad, 1, 13.0))[SILENT_FOR] == "not open"
