"""From a launch file that is no XML to the line that is to blame."""

from xml.parsers import expat

import pytest

from tutorial_check.exercises.launch_xml import QUOTES, not_xml, unclosed_node

NODE = '  <node pkg="rosbag" type="play" name="x" args="--loop a.bag"/>\n'


def diagnosis(text):
    """What not_xml says of a text, which Python must refuse."""
    with pytest.raises(expat.ExpatError) as raised:
        expat.ParserCreate().Parse(text.encode(), True)
    return not_xml(str(raised.value), text)


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("", None, "begins with <launch>"),
        (f"<launch>\n{NODE}", 1, "the <launch> of line 1 is never closed"),
        (
            f'<launch>\n{NODE}  <node pkg="x">\n{NODE}{NODE}</launch>\n',
            3,
            "the <node> of line 3 is never closed: /> at its end, or </node> below",
        ),
        (
            f"<launch>\n{NODE}  </node>\n</launch>\n",
            3,
            "</node> closes nothing: open is the <launch> of line 1",
        ),
        (
            '<launch>\n  <node pkg="x">\n  </nod>\n</launch>\n',
            3,
            "</nod> closes nothing: open is the <node> of line 2",
        ),
        (f"<launch>\n<!--\n{NODE}-->\n</launch>\n", 3, "no --"),
        (f"<launch>\n<!-- rosbag --->\n{NODE}</launch>\n", 2, "no --"),
        (f"<launch>\n{NODE}<!-- rosbag\n</launch>\n", 3, "needs its -->"),
        ('<launch>\n<node pkg="a type="b"/>\n</launch>\n', 2, QUOTES),
        (f'<launch>\n<node pkg="a" type="b/>\n{NODE}</launch>\n', 2, QUOTES),
        (f"<launch>\n{NODE}<node pkg=a/>\n</launch>\n", 3, QUOTES),
        (f'<launch>\n{NODE}<node pkg="a/>\n', 3, QUOTES),
        ('<launch>\n<node\xa0pkg="a"/>\n</launch>\n', 2, "came from the PDF"),
        ("<launch>\n<node pkg=“a”/>\n</launch>\n", 2, "curly quotes"),
        (f"<launch>\n</launch>\n{NODE}", 3, "before"),
        ('<launch>\n<node pkg="a"/\n</launch>\n', 2, "> or />"),
        ('<launch>\n<node pkg="ä" type="ö>\n</launch>\n', 2, QUOTES),
    ],
)
def test_the_culprit(text, line, words):
    found, hint = diagnosis(text)
    assert words in hint
    assert found == line


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (f"<launch>\n{NODE}<node>\n<remap/>\n<include/>\n</node></launch>", 3),
        ("<launch>\n<!-- <node> -->\n<node>\n</node>\n<include/></launch>", None),
        (f"<launch>\n{NODE}<include/></launch>", None),
    ],
)
def test_a_tag_within_a_node(text, line):
    assert unclosed_node(text, "include") == line
