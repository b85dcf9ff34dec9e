"""Launch files as roslaunch reads them: arguments, nodes, mistakes in a command line."""

import pytest

from tutorial_testing.processes import REPOSITORY

pytest.importorskip("roslaunch", reason="no ROS for this Python: ./tutorial setup")

from launch_kit.ros.launch_check import unknown
from launch_kit.ros.launch_tree import CALL, checked, read
from tutorial_testing.claims import claim

TWO_GROUPS = f"""<launch>
  <param name="checked" command="{CALL}"/>
  <arg name="world" default=""/>
  <arg name="path" value="$(arg world)"/>
  <param name="not_run" command="false"/>
  <group ns="a"><node pkg="rospy" type="none" name="base"/></group>
  <group ns="b" if="$(eval world != '')"><node pkg="rospy" type="none" name="base"/></group>
  <node pkg="rviz" type="rviz" name="my_rviz"/>
  <node pkg="rospy" type="none" name="$(anon base)"/>
</launch>"""
LAUNCH_BAG = str(REPOSITORY / "joy2twist/launch/launch_bag.launch")


def test_nodes_are_found_in_their_namespaces_and_arguments_that_no_file_has(tmp_path):
    file = tmp_path / "two.launch"
    file.write_text(TWO_GROUPS)
    words = ["-p", "11400", str(file), "world:=room", "wrold:=maze", "__name:=x"]
    tree = read([str(file)], words)
    assert tree.checked_nodes() == ["/a/base", "/b/base"]
    assert tree.values() == {"world": "room"}
    ignored = "which has world:=; did you mean world:=? (ignored)"
    assert unknown(words, tree) == [f"wrold:=maze: not an argument of two.launch, {ignored}"]
    file.write_text(TWO_GROUPS.replace("</launch>", "<include file='no'/></launch>"))
    tree = read([str(file)], words)
    assert tree.checked_nodes() == ["/a/base", "/b/base"]
    assert unknown(words, tree) == []  # roslaunch reports what is wrong


def test_what_a_students_own_launch_file_has_is_not_checked(tmp_path):
    file, inner = tmp_path / "outer.launch", tmp_path / "inner.launch"
    inner.write_text(TWO_GROUPS)
    node = '<node pkg="rospy" type="none" name="mine"/>'
    include = f'<include file="{inner}"><arg name="world" value="room"/></include>'
    file.write_text(f'<launch><arg name="x" default="a"/>{node}{include}</launch>')
    tree = read([str(file)], ["x:=b"])
    assert tree.checked_nodes() == ["/a/base", "/b/base"]
    assert [(a.name, a.value) for a in tree.checked_arguments()] == [("world", "room")]
    assert tree.values() == {"x": "b"}


@claim("A wrong argument or bag is named before the start")
@pytest.mark.parametrize(
    ("argument", "line"),
    [
        ("rviz=true", "rviz=true: not NAME:=VALUE, := is missing; did you mean rviz:=true.$"),
        ("rvz:=1", "rvz:=1: not an argument of launch_bag.launch, .*; did you mean rviz:=.$"),
        ("rviz:=yes", "rviz:=yes: must be true or false$"),
    ],
)
def test_a_wrong_argument_is_named(argument, line):
    with pytest.raises(ValueError, match=f"^{line}"):
        checked(LAUNCH_BAG, [argument])
