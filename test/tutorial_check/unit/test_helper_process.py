"""A helper that does not answer is abandoned, and its late answer is never used."""

import os

import pytest

from tutorial_check.errors import CannotCheck
from tutorial_check.processes.helper_process import Helper
from tutorial_testing.claims import claim


@claim("A helper that was late is asked no more")
def test_a_helper_that_was_late_is_asked_no_more(request, tmp_path):
    gate = tmp_path / "gate"  # read_text() waits for it
    os.mkfifo(gate)
    helper = Helper(lambda: gate, {})
    request.addfinalizer(helper.end)
    assert helper.call("exists") is True
    with pytest.raises(CannotCheck, match="hangs in read_text"):
        helper.call("read_text", deadline_s=0)
    with open(gate, "w"):
        pass
    with pytest.raises(CannotCheck, match="hangs in read_text"):
        helper.call("exists")
