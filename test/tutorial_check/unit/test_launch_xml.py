"""From a launch file that is not XML to a line and a hint."""

from xml.dom import minidom
from xml.parsers import expat

import pytest

from tutorial_check.checking.launch_errors import QUOTES, launch_error, not_xml
from tutorial_check.submission.launch_xml import Fault
from tutorial_testing.claims import claim

ENCODING = 'Python cannot read the encoding of its first line: write encoding="utf-8"'
NODE = '  <node pkg="rosbag" type="play" name="x" args="--loop a.bag"/>\n'


@claim("A launch file that is no XML has a line and a hint")
@pytest.mark.parametrize(("text", "line", "words"), [
    ("", None, "begins with <launch>"),
    (f'<launch>\n{NODE}  <node pkg="x">\n{NODE}</launch>\n', 3,
     "the <node> of line 3 is never closed: /> at its end, or </node> below"),
    ('<launch>\n  <node pkg="x">\n  </nod>\n</launch>\n', 3,
     "the open tag is the <node> of line 2"),
    (f"<launch>\n<!--\n{NODE}-->\n</launch>\n", 3, "must not contain --"),
    (f"<launch>\n<!-- rosbag --->\n{NODE}</launch>\n", 2, "must not contain --"),
    (f"<launch>\n{NODE}<!-- rosbag\n</launch>\n", 3, "needs its -->"),
    (f'<launch>\n<node pkg="a" type="b/>\n{NODE}</launch>\n', 2, QUOTES),
    (f'<launch>\n{NODE}<node pkg="a/>\n', 3, QUOTES),
    ('<launch>\n<node pkg="ä" type="ö>\n</launch>\n', 2, QUOTES),
    ('<launch>\n<node\xa0pkg="a"/>\n</launch>\n', 2, "a gap from the PDF"),
    (f"<launch>\n</launch>\n{NODE}", 3, "before"),
    ('<launch>\n<node pkg="a"/\n</launch>\n', 2, "> or />"),
])  # fmt: skip
def test_a_launch_file_that_is_no_xml_has_a_line_and_a_hint(text, line, words):
    with pytest.raises(expat.ExpatError) as raised:
        expat.ParserCreate().Parse(text.encode(), True)
    found, hint = not_xml(str(raised.value), text)
    assert words in hint
    assert found == line


def test_an_encoding_that_python_lacks_has_no_line():
    text = '<?xml version="1.0" encoding="shift_jis"?>\n<launch/>\n'
    with pytest.raises(ValueError, match="multi-byte") as raised:
        minidom.parseString(text.encode())
    assert not_xml(str(raised.value), text) == (None, ENCODING)


@pytest.mark.parametrize("may_see", [True, False])
@pytest.mark.parametrize("kind", ["no such file", "no such arg"])
def test_a_name_is_suggested_only_from_what_programs_may_see(tmp_path, kind, may_see):
    (tmp_path / "grades.launch").write_text('<launch><arg name="grades"/></launch>')
    words = f"file does not exist [{tmp_path}/grade.launch]"
    if kind == "no such arg":
        words = f"unused args [grade] for include of [{tmp_path}/grades.launch]"
    fault = Fault("RLException", words, "include", [("a.launch", 1)])
    wrong = launch_error(fault, "a.launch", 1, "<launch/>", lambda _: may_see)
    assert ("grades" in wrong.hint) == may_see
