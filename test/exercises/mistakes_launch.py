"""Mistakes in launch files, each a row: (exercise, what, edits, check, word or words of the diagnosis)."""

from edits import *

OWN = '  <node pkg="joy2twist" name="myjoystick2twist" type="joy2twist.py">\n  </node>\n'
ROBOT = '  <include file="$(find rbx1_bringup)/launch/fake_turtlebot.launch"/>\n'
JOY = '  <node pkg="joy" name="joy_node" type="joy_node">\n  </node>\n'
RVIZ = '  <node pkg="rviz" name="my_rviz" type="rviz" args="-d $(find rbx1_nav)/sim.rviz">\n  </node>\n'
INCLUDE = '  <include file="$(find joy2twist)/launch/joy2twist_turtlebot.launch"/>\n'
# Words of the mistakes below, in a comment: no place that a diagnosis may name.
COMMENT = (
    "<launch>",
    "<launch>\n  <!-- rviz, fake_turtlebot.launch, sim.rvz, joy2twist, joy_node, rosbag play -->",
)

bag, joy = mistake_in("5", LAUNCH_BAG), mistake_in("5", LAUNCH_JOY)
mux = mistake_in("6.1", TURTLEBOT)


def commented(file, change, check, *words):
    """A row with one change in a launch file that begins with a comment."""
    old, new = change
    what = f"{new} below a comment"
    return ("5", what, [put(file, old, new, 1), put(file, *COMMENT)], check, words)


INCLUDED = f"{J}/launch/more.launch"
INCLUDES = ("<launch>", '<launch>\n  <include file="$(find joy2twist)/launch/more.launch"/>', 1)


def included(what, line, word):
    """A row with one fault in the second line of a file that launch_bag.launch includes."""
    edits = [write(INCLUDED, f"<launch>\n  {line}\n</launch>\n"), put(LAUNCH_BAG, *INCLUDES)]
    return ("5", f"{what}, in an included file", edits, "C21", ("launch/more.launch:2", word))


ROWS = [
    ("5", "no launch_bag.launch", [remove(LAUNCH_BAG)], "C21", "no such file"),
    ("5", "misnamed", [move(LAUNCH_JOY, f"{J}/launch/launch_joynode.launch")], "C21", "launch_joynode"),
    bag("</node> missing", "  </node>\n  <include", "  <include", "C21", ("launch_bag.launch:2", "the <node> of line 2 is never closed")),
    ("5", "</node> only at the end", [put(LAUNCH_BAG, "  </node>\n  <include", "  <include"), put(LAUNCH_BAG, "</launch>", "  </node>\n</launch>")], "C21", ("launch_bag.launch:2", "<include> in it", "close it first")),
    ("5", "<Launch>", [put(LAUNCH_BAG, "launch>", "Launch>")], "C21", ("launch_bag.launch:1", "in lower case")),
    bag("</launch> missing", "</launch>", "", "C21", "the <launch> of line 1 is never closed"),
    bag("curly quotes", '"rviz"', "“rviz”", "C21", "curly"),
    bag("<Node>", '<node pkg="joy2twist" name="myjoystick2twist" type="joy2twist.py">\n  </node>', '<Node pkg="joy2twist" name="myjoystick2twist" type="joy2twist.py">\n  </Node>', "C21", "lower case"),
    bag("a package that does not exist", "$(find rbx1_bringup)", "$(find rbx1_bringupp)", "C21", "rbx1_bringupp"),
    bag("include without a path", "$(find rbx1_bringup)/launch/fake_turtlebot.launch", "fake_turtlebot.launch", "C21", "whole path"),
    bag("include pkg= file=", 'include file="$(find rbx1_bringup)/launch/fake_turtlebot.launch"', 'include pkg="rbx1_bringup" file="fake_turtlebot.launch"', "C21", "include"),
    bag("a node that is a launch file", ROBOT, '  <node pkg="rbx1_bringup" name="robot" type="fake_turtlebot.launch"/>\n', "C21", "<include"),
    bag("rospack in $(find)", "$(find rbx1_nav)", "$(rospack find rbx1_nav)", "C21", ("launch_bag.launch:2", "$(find rbx1_nav), without rospack")),
    bag("$(arg) without a name", '"-d ', '"-d $(arg) ', "C21", ("launch_bag.launch:2", "each $(arg x) needs an <arg name=")),
    bag("an arg without a value", '"-d ', '"-d $(arg d) ', "C21", ("launch_bag.launch:2", '<arg name="d" default=')),
    bag("a remap without from", "  </node>", '    <remap name="/cmd_vel" to="/x"/>\n  </node>', "C21", ("launch_bag.launch:3", "hint:     <remap from=")),
    bag("an include without a file", ROBOT, "  <include/>\n", "C21", ("launch_bag.launch:4", "an include has file=")),
    bag("two nodes of one name", 'name="my_rviz"', 'name="myjoystick2twist"', "C21", ("launch_bag.launch:5", "each node has a name of its own")),
    bag("type missing", ' type="joy2twist.py"', "", "C21", ("'type'", "launch_bag.launch:5")),
    bag("arg for args", 'args="--loop', 'arg="--loop', "C21", ("launch_bag.launch:7", "is args= meant?")),
    bag("the bag is one folder further down", "/bag/joy.bag", "/joy.bag", "C21", "$(find joy2twist)/bag/joy.bag"),
    bag("bag folder not made", "/bag/joy.bag", "/bags/joy.bag", "C21", "bag"),
    joy('pkg="joy2twist" type="joy_node"', 'pkg="joy" name="joy_node"', 'pkg="joy2twist" name="joy_node"', "C21", 'pkg="joy"'),
    bag("no RViz", RVIZ, "", "C22", "RViz"),
    bag("no robot", ROBOT, "", "C22", "robot"),
    bag("no joy2twist", OWN, "", "C22", "joy2twist"),
    bag("rosbag record", 'type="play"', 'type="record"', "C22", "rosbag play"),
    bag("two programs that drive", OWN, OWN + OWN.replace("my", "your").replace("joy2twist.py", "new_joy2twist.py"), "C22", ("launch_bag.launch:7", "2, joy2twist.py and new_joy2twist.py: all would drive")),
    bag("a joystick beside the recording", OWN, OWN + JOY, "C22", ("it starts a joystick, too", "launch_joy_node.launch has it")),
    bag("one dash", "--loop", "-loop", "C22", ("launch_bag.launch:7", "-loop, which it does not", "two plain hyphens: --loop")),
    bag("a long dash", "--loop", "\u2014clock", "C22", ("launch_bag.launch:7", "\u2014clock, which it does not", "two plain hyphens: --clock")),
    bag("bag without a path", "$(find joy2twist)/bag/joy.bag", "joy.bag", "C22", "whole path"),
    bag("cmd_vel remapped away", 'type="joy2twist.py">', 'type="joy2twist.py">\n  <remap from="/cmd_vel" to="/cmd"/>', "C23", "/cmd_vel"),
    joy("no joy_node", JOY, "", "C25", "joy_node"),
    joy("a recording beside the joystick", JOY, JOY + '  <node name="rosbag" pkg="rosbag" type="play" args="--loop $(find joy2twist)/bag/joy.bag"/>\n', "C25", "both"),
    joy("/joy remapped away", 'type="joy_node">', 'type="joy_node">\n  <remap from="joy" to="joystick"/>', "C25", ("launch_joy_node.launch:8", "sends them on /joystick")),
    ("6.1", "no joy2twist_turtlebot.launch", [remove(TURTLEBOT)], "C27", "no such file"),
    mux("remap swapped", REMAP, '<remap from="/cmd_vel_mux/input/teleop" to="/cmd_vel"/>', "C27", "swapped"),
    mux("a blank at the end of to", 'teleop"', 'teleop "', "C27", ("turtlebot.launch:3", "blank")),
    mux("a dot in a name", 'from="/cmd_vel"', 'from="/cmd.vel"', "C27", ("turtlebot.launch:3", "letters, digits")),
    mux("no remap", f"    {REMAP}\n", "", "C27", "remap"),
    mux("<param> for <remap>", REMAP, '<param name="/cmd_vel" value="/cmd_vel_mux/input/teleop"/>', "C27", "param"),
    mux("remap of another name", 'from="/cmd_vel"', 'from="/cmdvel"', "C27", "/cmdvel"),
    mux("mux misspelt", "cmd_vel_mux/input", "cmd_vel_mux", "C27", "/cmd_vel_mux/teleop"),
    ("6.1", "a copy with the topic in it", [copy(JOY2TWIST, f"{J}/scripts/turtlebot.py"), put(f"{J}/scripts/turtlebot.py", "/cmd_vel", "/cmd_vel_mux/input/teleop"), put(TURTLEBOT, "joy2twist.py", "turtlebot.py"), put(TURTLEBOT, f"    {REMAP}\n", "")], "C27", ("by itself", "turtlebot.launch:2", REMAP)),
    mux("no node", 'type="joy2twist.py"', 'type="joy2twst.py"', "C27", "joy2twst"),
    ("6.1", "no realTurtlebot.launch", [remove(REAL)], "C28", "no such file"),
    ("6.1", "capitals lost", [move(REAL, f"{J}/launch/launch_joy_node_realturtlebot.launch")], "C28", "realturtlebot"),
    ("6.1", "the include forgotten", [put(REAL, INCLUDE, "")], "C28", "include"),
    ("6.1", "no joystick", [put(REAL, JOY, "")], "C28", "joy_node"),
    ("6.1", "joy2twist twice", [put(REAL, JOY, JOY + OWN.replace("my", "your"))], "C28", "both"),
    commented(LAUNCH_BAG, ('type="joy2twist.py"', 'type="joy2twist"'), "C21", "launch_bag.launch:6", "joy2twist.py"),
    commented(LAUNCH_BAG, ("sim.rviz", "sim.rvz"), "C22", "launch_bag.launch:3"),
    commented(LAUNCH_JOY, ('type="joy_node"', 'type="joy_nod"'), "C21", "launch_joy_node.launch:8", 'type="joy_node"'),
    commented(LAUNCH_BAG, ("rbx1_bringup)", "rbx1_bringup"), "C21", "launch_bag.launch:5", "needs its )"),
    commented(LAUNCH_BAG, ("fake_turtlebot.launch", "fake_turtelbot.launch"), "C21", "launch_bag.launch:5", "is fake_turtlebot.launch meant"),
    bag("a gap in $(find)", "$(find rbx1_nav)", "$(find rbx1 nav)", "C21", ("launch_bag.launch:2", "$(find rbx1_nav)")),
    bag("type with its folder", 'type="joy2twist.py"', 'type="$(find joy2twist)/scripts/joy2twist.py"', "C21", ("launch_bag.launch:5", 'type="joy2twist.py"')),
    bag("a quote that is not closed", '"-d $(find', '"-d \'$(find', "C22", ("launch_bag.launch:2", "second quote")),
    ("5", "joy2twist.py misnamed, and the launch files right", [move(JOY2TWIST, f"{J}/scripts/Joy2Twist.py")], "C21", ("mv /", "/Joy2Twist.py /", "scripts/joy2twist.py: capitals")),
    ("5", "two launch files of one name", [copy(LAUNCH_BAG, f"{J}/backup/launch_bag.launch")], "C21", "multiple files named"),
    ("5", "a folder in place of a launch file", [remove(LAUNCH_BAG), write(f"{LAUNCH_BAG}/x", "")], "C21", "no such file"),
    ("5", "a recording that cannot be played", [write(f"{J}/bag/joy.bag", "none")], "C22", ("joy2twist/bag/joy.bag", "copy it again")),
    ("5", "a folder in place of the recording", [remove(f"{J}/bag/joy.bag"), write(f"{J}/bag/joy.bag/x", "")], "C22", "joy.bag"),
    ("5", "two packages of one name", [copy(f"{B}/package.xml", "old/package.xml")], "C21", ("old", "roslaunch starts nothing")),
    ("5", "a package.xml that catkin refuses", [put(f"{B}/package.xml", "<license>TODO</license>", "")], "C21", (f"{B}/package.xml", "license")),
    bag("a gap in pkg", 'pkg="rviz"', 'pkg="rviz one"', "C21", ("launch_bag.launch:2", 'pkg="rviz_one"')),
    bag("a package misspelt", "$(find rbx1_nav)", "$(find rbx1_nv)", "C21", ("launch_bag.launch:2", "rbx1_nav")),
    ("6.1", "the include misspelt", [put(REAL, "joy2twist_turtlebot", "joy2twist_turtelbot")], "C28", ("realTurtlebot.launch:3", "no such file: src/joy2twist", "is joy2twist_turtlebot.launch meant")),
    mux("remap after the node", f"    {REMAP}\n  </node>\n", f"  </node>\n  {REMAP}\n", "C27", ("turtlebot.launch:4", "between")),
    bag("--loop forgotten", "--loop ", "", "C24", ("launch_bag.launch:7", "rosbag play --loop")),
    bag("a missing package in an <arg>", "<launch>", '<launch>\n  <arg name="m" default="$(find no_such_pkg)/was"/>', "C21", ("launch_bag.launch:2", "package not found: no_such_pkg", "look at the spelling")),
    bag("xacro", "<launch>", '<launch>\n  <param name="robot_description" command="$(find xacro)/xacro robot.xacro"/>', "C21", ("launch_bag.launch:2", "package not found: xacro", "Debian lacks xacro; the simulated robot has")),
    bag("arbotix", OWN, OWN + '  <node pkg="arbotix_python" type="arbotix_driver" name="arbotix"/>\n', "C21", ("launch_bag.launch:7", "Debian lacks arbotix_python; fake_turtlebot.launch")),
    bag("a package that is not installed", OWN, OWN + '  <node pkg="image_view" type="image_view" name="view"/>\n', "C21", ("launch_bag.launch:7", "apt install libimage-view-dev ros-image-view")),
    bag("an unset variable", "<launch>", '<launch>\n  <arg name="base" default="$(env THE_BASE)"/>', "C21", ("launch_bag.launch:2", "environment variable 'THE_BASE' is not set", "export THE_BASE=")),
    bag("a missing rosparam file", "<launch>", '<launch>\n  <rosparam file="$(find joy)/launch/nowhere.yaml"/>', "C21", ("launch_bag.launch:2", "no such file:", "nowhere.yaml", "look at the name")),
    bag("a / in a node's name", 'name="my_rviz"', 'name="my/rviz"', "C21", ("launch_bag.launch:2", 'a "/" in the name= of a node', "ns=")),
    ("5", "an arg that the included file lacks", [write(INCLUDED, '<launch><arg name="world" default="room"/></launch>'), put(LAUNCH_BAG, "<launch>", INCLUDES[1].replace("/>", '><arg name="wrold" value="x"/></include>'), 1)], "C21", ("launch_bag.launch:2", "more.launch has no arg wrold", "is world meant?")),
    bag("a condition that is none", 'type="joy2twist.py"', 'if="maybe" type="joy2twist.py"', "C21", ("launch_bag.launch:5", "maybe is not a 'bool'")),
    included("a missing package", '<arg name="m" default="$(find no_such_pkg)/was"/>', "package not found: no_such_pkg"),
    included("a tag not closed", '<node pkg="joy">', "the <node> of line 2 is never closed"),
    included("a node that there is not", '<node pkg="joy" type="joy_nod" name="j"/>', "joy_nod"),
    included("an attribute that there is not", '<node pkg="joy" type="joy_node" name="j" arg="x"/>', "is args= meant?"),
    included("a missing file", '<include file="$(find joy)/launch/none.launch"/>', "no such file"),
    ("5", "an included file whose arg has no value", [write(INCLUDED, '<launch>\n  <arg name="dev"/>\n  <param name="d" value="$(arg dev)"/>\n</launch>\n'), put(LAUNCH_BAG, *INCLUDES)], "C21", ("launch/launch_bag.launch:2", "the arg dev has no value")),
    ("5", "rbx1 in src, which needs arbotix", [write("rbx1/rbx1_bringup/package.xml", "<package><name>rbx1_bringup</name><version>0.0.0</version><description>x</description><maintainer email='s@u.example'>s</maintainer><license>x</license></package>"), write("rbx1/rbx1_bringup/launch/fake_turtlebot.launch", '<launch>\n  <param name="m" command="$(find xacro)/xacro.py x"/>\n</launch>\n')], "C21", ("where:    rbx1/rbx1_bringup/launch/fake_turtlebot.launch:2", "Debian lacks xacro", "remove rbx1_bringup from src")),
    ("5", "no recording", [remove(f"{J}/bag/joy.bag")], "C21", ("cp \"$(rospack find gamepad)/bag/joy.bag\" /", f"src/{J}/bag")),
    ("4.2", "a damaged recording beside another one", [chatter(f"{B}/chatter.bag"), move(f"{J}/bag/joy.bag", f"{J}/bag/mine"), write("joy.bag", "none")], "C11", "where:    joy.bag"),
    ("4.2", "a recording that is none", [write(f"{J}/bag/joy.bag", "none")], "C11", "rospack find gamepad"),
]  # fmt: skip
