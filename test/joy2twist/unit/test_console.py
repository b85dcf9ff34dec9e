"""The node's lines on the screen."""

import io
import logging
import re

import pytest
from rosgraph.roslogging import RosStreamHandler

from joy_to_twist.ros.console import Console


@pytest.mark.parametrize("form", [None, "[${node}] ${severity}: ${message}"])
def test_a_line_is_written_as_rospy_writes_it(form, monkeypatch, capsys):
    monkeypatch.delenv("ROSCONSOLE_FORMAT", raising=False)
    if form:
        monkeypatch.setenv("ROSCONSOLE_FORMAT", form)
    record, screen = logging.LogRecord("", logging.INFO, "", 0, "gone", (), None), io.StringIO()
    RosStreamHandler(colorize=False, stdout=screen).emit(record)
    Console(log_rate=50).goodbye("gone")
    both = capsys.readouterr().out, screen.getvalue()
    written, right = (re.sub(r"\d+\.\d{6}", "TIME", text) for text in both)
    assert written == right
    assert "gone\n" in written
