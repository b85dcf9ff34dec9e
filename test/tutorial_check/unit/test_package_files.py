"""Files of a package, and lines in them."""

import pytest

from tutorial_check.checking.package_files import File, Script
from tutorial_check.checking.results import Wrong


def test_a_file_names_the_line_of_the_first_word_that_is_there(make_submission):
    submission = make_submission("p", "1")
    (submission.package("p").folder / "a.py").write_text("one\ntwo\n")
    file = File(submission, "p", "a.py")
    for words, where in (("two one", "a.py:2"), ("three one", "a.py:1"), ("three", "a.py")):
        with pytest.raises(Wrong) as wrong:
            file.must([], words, "this", 7)
        assert (wrong.value.seen, wrong.value.where) == ("7", where)
    with pytest.raises(Wrong, match="no such file in the package"):
        File(submission, "p", "b.py")


def test_a_script_names_the_lines_of_its_calls(make_submission):
    submission = make_submission("p", "1")
    (submission.package("p").folder / "a.py").write_text("import rospy\nwhile True:\n    f(1)\n")
    script = Script(submission, "p", "a.py")
    assert (script.at_call("f"), script.at_call("g")) == ("a.py:3", "a.py")
    with pytest.raises(Wrong, match="it had to be killed") as wrong:
        script.check_end(None, "")
    assert wrong.value.where == "a.py:2"
