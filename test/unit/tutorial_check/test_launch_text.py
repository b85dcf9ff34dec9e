"""From a launch file and roslaunch's words to a line and a hint."""

import pytest

from tutorial_check.exercises.launch_text import parse_error, place_of, without_comments

TEXT = """<launch>
  <!-- rviz and
       sim.rviz -->
  <node pkg="rviz" type="rviz" args="-d $(find rbx1_nav)/sim.rviz"/>
</launch>
"""


def test_a_comment_is_no_place():
    text = without_comments(TEXT)
    assert len(text.splitlines()) == len(TEXT.splitlines())
    assert place_of("a.launch", text, "rviz") == "a.launch:4"
    assert place_of("a.launch", text, "nothing", "<node") == "a.launch:4"
    assert place_of("a.launch", text, "nothing") == "a.launch"


@pytest.mark.parametrize(
    ("old", "new", "error", "word"),
    [
        ("rbx1_nav", "rbx1 nav", "[find rbx1 nav]", "$(find rbx1_nav)"),
        ('pkg="rviz"', 'pkg="rviz one"', "rviz one", 'pkg="rviz_one"'),
        ("rbx1_nav)", "rbx1_nav", "[Errno 2] No such file", "needs its )"),
        ("rbx1_nav", "rbx1_nv", "rbx1_nv ROS path [0]=/x", "is rbx1_nav meant?"),
        ('"rviz"', "“rviz”", "not well-formed (invalid token): line 4, column 12", "curly"),
        (
            "$(find",
            "$(rospack find",
            "Unknown substitution command [rospack find rbx1_nav]. Valid commands are ['arg']",
            "$(find rbx1_nav), without rospack",
        ),
        ("$(find", "$(finde", "Unknown substitution command [finde rbx1_nav]", "no $(finde ...)"),
        ("-d", "$(arg)", "$(arg var) must specify a variable name [arg]", "<arg name="),
        ("-d", "$(arg d)", "[a.launch] requires the 'd' arg to be set", 'name="d" default='),
        (
            "<node",
            '<arg name="d"/><node',
            "[a.launch] requires the 'd' arg to be set",
            'name="d" default=',
        ),
        (
            ' type="rviz"',
            "",
            "<node> tag is missing required attribute: 'type'",
            "pkg=, type= and name=",
        ),
        (
            "/>",
            '><remap name="/cmd_vel" to="/x"/></node>',
            "Invalid <node> tag: <remap> tag is missing required from/to attributes: <remap"
            ' name="/cmd_vel" to="/x"/>. Node xml is <node pkg="rviz">',
            '<remap from="',
        ),
        ("<node", "<include/><node", "'file'", "an include has file="),
        ("-d", "/cmd_vel ", "remap to [/cmd_vel ] is not a valid ROS name", '"/cmd_vel"'),
        ("-d", "/cmd.vel", "remap to [/cmd.vel] is not a valid ROS name", "letters, digits"),
    ],
)
def test_what_roslaunch_cannot_read(old, new, error, word):
    wrong = parse_error(error, "a.launch", TEXT.replace(old, new))
    assert word in wrong.hint
    assert wrong.where == "a.launch:4"


@pytest.mark.parametrize("other", ['<node name="joy"/>', '<param name="joy" value="1"/>'])
def test_two_nodes_of_one_name(other):
    text = f'<launch>\n<node name="joy"/>\n{other}\n<node\n  name="joy"/>\n</launch>'
    error = "roslaunch file contains multiple nodes named [/a/joy]. Please check all <node> 'name'"
    wrong = parse_error(error, "a.launch", text)
    assert wrong.where == ("a.launch:3" if "node" in other else "a.launch:5")
    assert wrong.hint == "each node has a name of its own, those of included files as well"


def test_a_file_that_is_not_there(tmp_path):
    (tmp_path / "sim.launch").touch()
    for path, word in (
        (tmp_path / "simm.launch", "is sim.launch meant?"),
        ("simm.launch", "whole"),
    ):
        error = f"[Errno 2] No such file or directory: '{path}'"
        wrong = parse_error(error, "a.launch", '<launch>\n<include file="simm.launch"/>')
        assert word in wrong.hint
        assert wrong.where == "a.launch:2"
