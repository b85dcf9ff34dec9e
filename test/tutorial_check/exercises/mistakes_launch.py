"""Mistakes in launch files."""

from edits import chatter, copy, move, put, remove, write
from manifests import manifest
from rows import mistake, mistake_in
from solution import JOY2TWIST, JOY_BAG, LAUNCH_BAG, LAUNCH_JOY, REAL, REMAP, TURTLEBOT, XML, B, J

OWN = '  <node pkg="joy2twist" name="myjoystick2twist" type="joy2twist.py">\n  </node>\n'
ROBOT = '  <include file="$(find rbx1_bringup)/launch/fake_turtlebot.launch"/>\n'
JOY = '  <node pkg="joy" name="joy_node" type="joy_node">\n  </node>\n'
RVIZ_ARGS = ' args="-d $(find rbx1_nav)/sim.rviz"'
RVIZ = f'  <node pkg="rviz" name="my_rviz" type="rviz"{RVIZ_ARGS}>\n  </node>\n'
INCLUDE = '  <include file="$(find joy2twist)/launch/joy2twist_turtlebot.launch"/>\n'
# Words of the mistakes below, in a comment: no place that a diagnosis may name.
COMMENT = "&\n  <!-- rviz, fake_turtlebot.launch, sim.rvz, joy2twist, joy_node, rosbag play -->"


def commented(file, old, new, check, *words):
    """A row with one change in a launch file that begins with a comment."""
    edits = [put(file, old, new), put(file, "<launch>", COMMENT)]
    return mistake(f"{new} below a comment", edits, check, *words)


INCLUDED = f"{J}/launch/more.launch"
INCLUDE_MORE = INCLUDE.replace("joy2twist_turtlebot", "more")
WRONG_ARG = INCLUDE_MORE.replace("/>", '><arg name="wrold" value="x"/></include>')
INCLUDES = put(LAUNCH_BAG, "<launch>\n", f"&{INCLUDE_MORE}")


def included(what, line, word):
    """A row with one fault in the second line of a file that launch_bag.launch includes."""
    edits = [write(INCLUDED, f"<launch>\n  {line}\n</launch>\n"), INCLUDES]
    return mistake(f"{what}, in an included file", edits, "C21", "launch/more.launch:2", word)


bag21, bag22, bag23, bag24 = (
    mistake_in(LAUNCH_BAG, check) for check in ("C21", "C22", "C23", "C24")
)
joy21, joy25 = mistake_in(LAUNCH_JOY, "C21"), mistake_in(LAUNCH_JOY, "C25")
mux = mistake_in(TURTLEBOT, "C27")
real = mistake_in(REAL, "C28")
ROWS = [
    mistake("a damaged recording beside another one", [chatter(f"{B}/chatter.bag"),
        move(JOY_BAG, f"{J}/bag/mine"), write("joy.bag", "none")], "C11", "where:    joy.bag"),
    mistake("a recording that is none", [write(JOY_BAG, "none")], "C11", "rospack find gamepad"),
    bag21("</node> missing", "  </node>\n  <include", "  <include", "launch_bag.launch:2",
        "the <node> of line 2 is never closed"),
    bag21("<Launch>", "launch>", "Launch>", "launch_bag.launch:1", "in lower case"),
    bag21("</launch> missing", "</launch>", "", "the <launch> of line 1 is never closed"),
    bag21("curly quotes", 'pkg="rviz"', 'pkg=“rviz”', "curly"),
    bag21("<Node>", '<node pkg="joy2twist" name="myjoystick2twist" type="joy2twist.py">\n  </node>',
        '<Node pkg="joy2twist" name="myjoystick2twist" type="joy2twist.py">\n  </Node>',
        "lower case"),
    bag21("a package that does not exist", "$(find rbx1_bringup)", "$(find rbx1_bringupp)",
        "rbx1_bringupp"),
    bag21("include without a path", "$(find rbx1_bringup)/launch/fake_turtlebot.launch",
        "fake_turtlebot.launch", "whole path"),
    bag21("include pkg= file=", 'include file="$(find rbx1_bringup)/launch/fake_turtlebot.launch"',
        'include pkg="rbx1_bringup" file="fake_turtlebot.launch"', "include"),
    bag21("a node that is a launch file", ROBOT,
        '  <node pkg="rbx1_bringup" name="robot" type="fake_turtlebot.launch"/>\n', "<include"),
    bag21("rospack in $(find)", "$(find rbx1_nav)", "$(rospack find rbx1_nav)",
        "launch_bag.launch:2", "$(find rbx1_nav), without rospack"),
    bag21("$(arg) without a name", '"-d ', '"-d $(arg) ', "launch_bag.launch:2",
        "each $(arg x) needs an <arg name="),
    bag21("an arg without a value", '"-d ', '"-d $(arg d) ', "launch_bag.launch:2",
        '<arg name="d" default='),
    bag21("a remap without from", 'rviz">\n', '&    <remap name="/cmd_vel" to="/x"/>\n',
        "launch_bag.launch:3", "hint:     <remap from="),
    bag21("an include without a file", ROBOT, "  <include/>\n", "launch_bag.launch:4",
        "an include has file="),
    bag21("two nodes of one name", 'name="my_rviz"', 'name="myjoystick2twist"',
        "launch_bag.launch:5", "each node has a name of its own"),
    bag21("type missing", ' type="joy2twist.py"', "", "'type'", "launch_bag.launch:5"),
    bag21("arg for args", 'args="--loop', 'arg="--loop', "launch_bag.launch:7", "is args= meant?"),
    bag21("the bag is one folder further down", "/bag/joy.bag", "/joy.bag",
        "$(find joy2twist)/bag/joy.bag"),
    bag21("bag folder not made", "/bag/joy.bag", "/bags/joy.bag", "bag"),
    bag21("a gap in $(find)", "$(find rbx1_nav)", "$(find rbx1 nav)", "launch_bag.launch:2",
        "$(find rbx1_nav)"),
    bag21("type with its folder", 'type="joy2twist.py"',
        'type="$(find joy2twist)/scripts/joy2twist.py"', "launch_bag.launch:5",
        'type="joy2twist.py"'),
    bag21("a gap in pkg", 'pkg="rviz"', 'pkg="rviz one"', "launch_bag.launch:2", 'pkg="rviz_one"'),
    bag21("a package misspelt", "$(find rbx1_nav)", "$(find rbx1_nv)", "launch_bag.launch:2",
        "rbx1_nav"),
    bag21("a missing package in an <arg>", "<launch>",
        '<launch>\n  <arg name="m" default="$(find no_such_pkg)/was"/>', "launch_bag.launch:2",
        "package not found: no_such_pkg", "look at the spelling"),
    bag21("xacro", "<launch>",
        '<launch>\n  <param name="robot_description" command="$(find xacro)/xacro robot.xacro"/>',
        "launch_bag.launch:2", "package not found: xacro",
        "Debian lacks xacro; the simulated robot has"),
    bag21("arbotix", OWN, '&  <node pkg="arbotix_python" type="arbotix_driver" name="base"/>\n',
        "launch_bag.launch:7", "Debian lacks arbotix_python; fake_turtlebot.launch"),
    bag21("a package that is not installed", OWN,
        '&  <node pkg="image_view" type="image_view" name="view"/>\n', "launch_bag.launch:7",
        "apt install libimage-view-dev ros-image-view"),
    bag21("an unset variable", "<launch>",
        '<launch>\n  <arg name="base" default="$(env THE_BASE)"/>', "launch_bag.launch:2",
        "environment variable 'THE_BASE' is not set", "export THE_BASE="),
    bag21("a missing rosparam file", "<launch>",
        '<launch>\n  <rosparam file="$(find joy)/launch/nowhere.yaml"/>', "launch_bag.launch:2",
        "no such file:", "nowhere.yaml", "look at the name"),
    bag21("a / in a node's name", 'name="my_rviz"', 'name="my/rviz"', "launch_bag.launch:2",
        'a "/" in the name= of a node', "ns="),
    bag21("a condition that is none", 'type="joy2twist.py"', 'if="maybe" &', "launch_bag.launch:5",
        "maybe is not a 'bool'"),
    joy21('pkg="joy2twist" type="joy_node"', 'pkg="joy" name="joy_node"',
        'pkg="joy2twist" name="joy_node"', 'pkg="joy"'),
    mistake("no launch_bag.launch", [remove(LAUNCH_BAG)], "C21", "no such file"),
    mistake("misnamed", [move(LAUNCH_JOY, f"{J}/launch/launch_joynode.launch")], "C21",
        "launch_joynode"),
    mistake("</node> only at the end", [put(LAUNCH_BAG, "  </node>\n  <include", "  <include"),
        put(LAUNCH_BAG, "</launch>", "  </node>\n&")], "C21", "launch_bag.launch:2",
        "<include> in it", "close it first"),
    mistake("joy2twist.py misnamed, and the launch files right",
        [move(JOY2TWIST, f"{J}/scripts/Joy2Twist.py")], "C21", "mv /", "/Joy2Twist.py /",
        "scripts/joy2twist.py: capitals"),
    mistake("two launch files of one name", [copy(LAUNCH_BAG, f"{J}/backup/launch_bag.launch")],
        "C21", "multiple files named"),
    mistake("a folder in place of a launch file",
        [remove(LAUNCH_BAG), write(f"{LAUNCH_BAG}/x", "")], "C21", "no such file"),
    mistake("two packages of one name", [copy(XML, "old/package.xml")], "C21", "old",
        "roslaunch starts nothing"),
    mistake("a package.xml that catkin refuses", [put(XML, "<license>TODO</license>", "")], "C21",
        XML, "license"),
    mistake("an arg that the included file lacks", [write(INCLUDED,
        '<launch><arg name="world" default="room"/></launch>'),
        put(LAUNCH_BAG, "<launch>\n", f"&{WRONG_ARG}")], "C21", "launch_bag.launch:2",
        "more.launch has no arg wrold", "is world meant?"),
    mistake("an included file whose arg has no value", [write(INCLUDED,
        '<launch>\n  <arg name="dev"/>\n  <param name="d" value="$(arg dev)"/>\n</launch>\n'),
        INCLUDES], "C21", "launch/launch_bag.launch:2", "the arg dev has no value"),
    mistake("rbx1 in src, which needs arbotix", [write("rbx1/rbx1_bringup/package.xml",
        manifest("rbx1_bringup")), write("rbx1/rbx1_bringup/launch/fake_turtlebot.launch",
        '<launch>\n  <param name="m" command="$(find xacro)/xacro.py x"/>\n</launch>\n')], "C21",
        "where:    rbx1/rbx1_bringup/launch/fake_turtlebot.launch:2", "Debian lacks xacro",
        "remove rbx1_bringup from src"),
    mistake("no recording", [remove(JOY_BAG)], "C21",
        "cp \"$(rospack find gamepad)/bag/joy.bag\" /", f"src/{J}/bag"),
    bag22("no RViz", RVIZ, "", "RViz"),
    bag22("no robot", ROBOT, "", "robot"),
    bag22("no joy2twist", OWN, "", "joy2twist"),
    bag22("rosbag record", 'type="play"', 'type="record"', "rosbag play"),
    bag22("two programs that drive", OWN,
        OWN + OWN.replace("my", "your").replace("joy2twist.py", "new_joy2twist.py"),
        "launch_bag.launch:7", "2, joy2twist.py and new_joy2twist.py: all would drive"),
    bag22("a joystick beside the recording", OWN, OWN + JOY, "it starts a joystick, too",
        "launch_joy_node.launch has it"),
    bag22("one dash", "--loop", "-loop", "launch_bag.launch:7", "-loop, which it does not",
        "two plain hyphens: --loop"),
    bag22("a long dash", "--loop", "\u2014clock", "launch_bag.launch:7",
        "\u2014clock, which it does not", "two plain hyphens: --clock"),
    bag22("bag without a path", "$(find joy2twist)/bag/joy.bag", "joy.bag", "whole path"),
    bag22("a quote that is not closed", '"-d $(find', '"-d \'$(find', "launch_bag.launch:2",
        "closing quote"),
    mistake("a recording that cannot be played", [write(JOY_BAG, "none")], "C22",
        "joy2twist/bag/joy.bag", "copy it again"),
    mistake("a folder in place of the recording",
        [remove(JOY_BAG), write(f"{J}/bag/joy.bag/x", "")], "C22", "joy.bag"),
    bag23("cmd_vel remapped away", 'type="joy2twist.py">',
        '&\n  <remap from="/cmd_vel" to="/cmd"/>', "/cmd_vel"),
    bag24("--loop forgotten", "--loop ", "", "launch_bag.launch:7", "rosbag play --loop"),
    joy25("no joy_node", JOY, "", "joy_node"),
    joy25("a recording beside the joystick", JOY,
        '&  <node name="rosbag" pkg="rosbag" type="play" args="--loop $(find '
        'joy2twist)/bag/joy.bag"/>\n', "both"),
    joy25("/joy remapped away", 'type="joy_node">', '&\n  <remap from="joy" to="joystick"/>',
        "launch_joy_node.launch:8", "sends them on /joystick"),
    mux("remap swapped", REMAP, '<remap from="/cmd_vel_mux/input/teleop" to="/cmd_vel"/>',
        "swapped"),
    mux("a blank at the end of to", 'teleop"', 'teleop "', "turtlebot.launch:3", "blank"),
    mux("a dot in a name", 'from="/cmd_vel"', 'from="/cmd.vel"', "turtlebot.launch:3",
        "letters, digits"),
    mux("no remap", f"    {REMAP}\n", "", "remap"),
    mux("<param> for <remap>", REMAP, '<param name="/cmd_vel" value="/cmd_vel_mux/input/teleop"/>',
        "param"),
    mux("remap of another name", 'from="/cmd_vel"', 'from="/cmdvel"', "/cmdvel"),
    mux("mux misspelt", "cmd_vel_mux/input", "cmd_vel_mux", "/cmd_vel_mux/teleop"),
    mux("no node", 'type="joy2twist.py"', 'type="joy2twst.py"', "joy2twst"),
    mux("remap after the node", f"    {REMAP}\n  </node>\n", f"  </node>\n  {REMAP}\n",
        "turtlebot.launch:4", "between"),
    mistake("no joy2twist_turtlebot.launch", [remove(TURTLEBOT)], "C27", "no such file"),
    mistake("a copy with the topic in it", [copy(JOY2TWIST, f"{J}/scripts/turtlebot.py"),
        put(f"{J}/scripts/turtlebot.py", "/cmd_vel", "&_mux/input/teleop"),
        put(TURTLEBOT, "joy2twist.py", "turtlebot.py"), put(TURTLEBOT, f"    {REMAP}\n", "")],
        "C27", "by itself", "turtlebot.launch:2", REMAP),
    real("the include forgotten", INCLUDE, "", "include"),
    real("no joystick", JOY, "", "joy_node"),
    real("joy2twist twice", JOY, JOY + OWN.replace("my", "your"), "both"),
    real("the include misspelt", "joy2twist_turtlebot", "joy2twist_turtelbot",
        "realTurtlebot.launch:3", "no such file: src/joy2twist",
        "is joy2twist_turtlebot.launch meant"),
    mistake("no realTurtlebot.launch", [remove(REAL)], "C28", "no such file"),
    mistake("capitals lost", [move(REAL, f"{J}/launch/launch_joy_node_realturtlebot.launch")],
        "C28", "realturtlebot"),
    commented(LAUNCH_BAG, 'type="joy2twist.py"', 'type="joy2twist"', "C21", "launch_bag.launch:6",
        "joy2twist.py"),
    commented(LAUNCH_BAG, "sim.rviz", "sim.rvz", "C22", "launch_bag.launch:3"),
    commented(LAUNCH_JOY, 'type="joy_node"', 'type="joy_nod"', "C21", "launch_joy_node.launch:8",
        'type="joy_node"'),
    commented(LAUNCH_BAG, "rbx1_bringup)", "rbx1_bringup", "C21", "launch_bag.launch:5",
        "needs its )"),
    commented(LAUNCH_BAG, "fake_turtlebot.launch", "fake_turtelbot.launch", "C21",
        "launch_bag.launch:5", "is fake_turtlebot.launch meant"),
    included("a missing package", '<arg name="m" default="$(find no_such_pkg)/was"/>',
        "package not found: no_such_pkg"),
    included("a tag not closed", '<node pkg="joy">', "the <node> of line 2 is never closed"),
    included("a node that there is not", '<node pkg="joy" type="joy_nod" name="j"/>', "joy_nod"),
    included("an attribute that there is not", '<node pkg="joy" type="joy_node" name="j" arg="x"/>',
        "is args= meant?"),
    included("a missing file", '<include file="$(find joy)/launch/none.launch"/>', "no such file"),
]  # fmt: skip
