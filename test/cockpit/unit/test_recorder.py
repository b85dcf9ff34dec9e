"""Who may record, how a recording ends, and that only one runs."""

import re
from types import SimpleNamespace

import pytest

from cockpit_server.errors import RefusedError
from cockpit_server.pages import LOOKS_ONLY
from cockpit_server.ros.tabs import recorder
from tutorial_testing.claims import claim
from tutorial_testing.session_room import page
from tutorial_testing.waiting import wait_for

pytestmark = claim(
    "A recording that cannot be made for lack of space, or ends by itself, says so; each has a "
    "name of its own"
)
# Replaces rosbag record: it writes a line into its file when it ends by SIGINT.
FAKE = 'trap \'echo whole > "$0"; exit\' INT; touch "$0.active"; for n in {1..99}; do sleep 1; done'


@pytest.fixture
def one(monkeypatch, tmp_path):
    monkeypatch.setattr(recorder, "COMMAND", ("bash", "-c", FAKE))
    monkeypatch.chdir(tmp_path)
    made = recorder.Recorder()
    yield made
    made._stop()


def test_one_recording_ends_whole(one, tmp_path):
    (driver, sent), (viewer, _) = page(bag=True), page("viewer")
    one.send_to(driver, 0.0)
    for on in (True, False):
        with pytest.raises(RefusedError, match=LOOKS_ONLY):
            one.on_record(viewer, 0.0, on)
    one.on_record(driver, 0.0, on=True)
    with pytest.raises(RefusedError, match="is being recorded"):
        one.on_record(driver, 0.0, on=True)
    one.send_to(driver, 0.0)
    wait_for(lambda: list(tmp_path.glob("*.active")), "recording")
    one.on_record(driver, 0.0, on=False)
    [path] = wait_for(lambda: list(tmp_path.glob("page_*.bag")), "file")
    wait_for(lambda: path.read_text() == "whole\n", "its end")
    wait_for(lambda: one._name == "", "its name")
    one.send_to(driver, 0.0)
    assert [said["name"] for said in sent] == ["", path.name, ""]


@claim("Tab Bag records ...", because="a cockpit that is killed")
def test_a_recording_ends_whole_with_the_thread_that_started_it(one, monkeypatch, tmp_path):
    """As in a cockpit that is killed, whose threads all end at once."""
    wait = lambda _: not wait_for(lambda: list(tmp_path.glob("*.active")), "begin")  # noqa: E731
    monkeypatch.setattr(recorder.Popen, "wait", wait)
    one.on_record(page()[0], 0.0, on=True)
    [path] = wait_for(lambda: list(tmp_path.glob("page_*.bag")), "file")
    wait_for(lambda: path.read_text() == "whole\n", "its end")


def test_without_space_nothing_is_recorded_and_what_is_recorded_ends_with_the_reason(
    one, monkeypatch, tmp_path
):
    driver, sent = page(bag=True)
    free = [recorder.LEAST_FREE - 1]
    usage = lambda _: SimpleNamespace(free=free[0])  # noqa: E731
    monkeypatch.setattr(recorder.shutil, "disk_usage", usage)
    with pytest.raises(RefusedError, match="less than 1 GB is free"):
        one.on_record(driver, 0.0, on=True)
    free[0] += 1
    one.on_record(driver, 0.0, on=True)
    wait_for(lambda: list(tmp_path.glob("*.active")), "recording")
    name = one._name
    one.send_to(driver, 9.9)
    assert sent[-1] == {"kind": "recorder", "name": name, "why": "", "seconds": 9}
    one.collect([], 1.0)
    free[0] -= 1
    one.collect([], 1.5)
    assert one._why == ""  # checked once a second
    one.collect([], 2.0)
    wait_for(lambda: one._name == "", "its end")
    one.send_to(driver, 0.0)
    assert sent[-1]["why"] == f"{name} has ended: {recorder.NO_SPACE}"


@pytest.mark.parametrize(("code", "why"), [(0, recorder.FULL), (3, r"has failed \(3\)")])
def test_a_recording_that_ends_by_itself_says_why(one, monkeypatch, code, why):
    monkeypatch.setattr(recorder, "COMMAND", ("bash", "-c", f"exit {code}"))
    one.on_record(page()[0], 0.0, on=True)
    wait_for(lambda: one._name == "", "its end")
    assert re.search(why, one._why)


def test_recordings_of_one_second_have_names_of_their_own(one, monkeypatch, tmp_path):
    monkeypatch.setattr(recorder.time, "strftime", lambda _: "page")
    names = []
    for end in ("", ".active", ""):
        names.append(recorder.free_name())
        (tmp_path / f"{names[-1]}{end}").touch()
    assert names == ["page.bag", "page_1.bag", "page_2.bag"]
