"""The process that reads what was handed in ends with one line, whatever happens."""

import sys
import textwrap
import threading

import pytest

from tutorial_check.errors import CannotCheck
from tutorial_check.examining import examination
from tutorial_check.recording import worker_process
from tutorial_check.submission.order import Order
from tutorial_testing.waiting import wait_for

# Replaces judging.examine(); Linux limits processor time in whole seconds.
PROCESS = """#!/usr/bin/python3
import os, re, resource, sys, time
from tutorial_check.examining import examination, judging
from tutorial_check.sandbox import privileges

privileges.OF_READER[resource.RLIMIT_CPU] = 1

def examine(order, report, side_by_side):
{body}

judging.examine = examine
sys.argv = sys.argv[-2:]
examination.main()
"""


@pytest.fixture
def examine(tmp_path, monkeypatch):
    """examine(body of the function that examines): its result, and what was reported."""
    monkeypatch.setattr(examination, "sourced", lambda order: order)

    def examined(body):
        program = tmp_path / "python"
        program.write_text(PROCESS.format(body=textwrap.indent(body, "    ")))
        program.chmod(0o755)
        monkeypatch.setattr(sys, "executable", str(program))
        reported = []
        order = Order(tmp_path, "setup.bash", ("3",))
        return examination.examine(order, lambda *result: reported.append(result)), reported

    return examined


def test_what_it_finds_is_reported_as_it_comes(examine):
    outcomes, reported = examine("report('3', 'C5'); report('3', 'C6')\nreturn ['all']")
    assert outcomes == ["all"] and reported == [("3", "C5"), ("3", "C6")]


@pytest.mark.parametrize(("body", "words"), [
    ("re.match('(a+)+$', 'a' * 60 + 'b')", "takes more than 20 s"),
    ("b'x' * (1 << 30)", "MB of memory"), ("os._exit(3)", "exit code 3"),
    ("os.kill(os.getpid(), 11)", "Segmentation fault"), ("return [0][1]", "a fault of the check"),
])  # fmt: skip
def test_a_process_that_cannot_go_on_is_one_line(examine, body, words):
    with pytest.raises(CannotCheck, match=words) as caught:
        examine(body)
    assert "\n" not in str(caught.value)


def test_who_no_longer_waits_ends_what_it_has_started(examine, tmp_path, monkeypatch):
    """As with Ctrl-C in a class, the process has time to stop what it started."""
    monkeypatch.setattr(worker_process, "no_more", threading.Event())
    monkeypatch.setattr(examination, "no_more", worker_process.no_more)
    started, ended = tmp_path / "started", tmp_path / "ended"
    body = f"open({str(started)!r}, 'w')\ntry:\n    time.sleep(60)\n"
    body += f"finally:\n    open({str(ended)!r}, 'w')"

    def stop():
        wait_for(started.exists, "the process examines")
        worker_process.no_more.set()

    waiter = threading.Thread(target=stop)
    waiter.start()
    with pytest.raises(CannotCheck, match="it was ended"):
        examine(body)
    waiter.join()
    assert ended.exists()
