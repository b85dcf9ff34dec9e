"""The pages of the ROS wiki that the handout links, and those that follow them, as a student types.

Rows in the pages' order: the terminal, what is typed there, and a pattern of its output. A table of
TUTORIAL.md says what differs from a page.
"""

import re

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY
from tutorial_testing.student import CTRL_C, END

TALKERS = REPOSITORY / "test/tutorial_check/exercises/literal/beginner_tutorials/scripts"
WRITTEN = REPOSITORY / "test/suite/system/linked_pages"  # what the pages show, in our own words
SOLVED = REPOSITORY / "common/courses/wiki/solutions/right/beginner_tutorials"
WS = "~/ros/hydro/catkin_ws"
TWIST = "geometry_msgs/Twist"
TALKS = r"good day(.*\n)+.*good day"  # a Ctrl-C during the first line may deadlock rospy
CMD_VEL = f"/turtle1/cmd_vel {TWIST}"
RECORD = "stdbuf -oL rosbag record"  # prints at once, as on a screen


def in_a_tty(command):
    """Return the line that runs a command in a new terminal, which passes keys on."""
    return f"script -qc '{command}' /dev/null; echo ended-$((1000 + 7))"


FILESYSTEM = [
    ("1", "printenv | grep ROS", "ROS_PACKAGE_PATH=.*/catkin_ws/src"),
    ("1", "rospack find roscpp", "/share/roscpp$"),
    ("1", "roscd roscpp/cmake && pwd", "/share/roscpp/cmake$"),
    ("1", "rosls roscpp", "^package.xml"),
]
CREATING_A_PACKAGE = [
    ("1", f"cd {WS}/src", ""),
    ("1", "catkin_create_pkg beginner_tutorials std_msgs rospy roscpp", "Successfully created"),
    ("1", f"cd {WS}\ncatkin_make\n. devel/setup.bash", "Running command"),
    ("1", "rospack depends1 beginner_tutorials", "^roscpp\nrospy\nstd_msgs"),
    ("1", "rospack depends1 rospy", "^roscpp"),
    ("1", "rospack depends beginner_tutorials", "^genmsg"),
    ("1", "roscd beginner_tutorials\ncat package.xml", "<name>beginner_tutorials"),
]
WORKSPACES = [("1", f"cd {WS}\ncatkin_make install\nls", "^build +devel +install +src|^install$")]
NODES = [
    ("core", "roscore", "started core service"),
    ("1", "roscd log && pwd", "/.ros/log/.+-.+-"),
    ("1", "rosnode list", "^/rosout"),
    ("1", "rosnode info /rosout", "/rosout/set_logger_level"),
    ("sim", "rosrun turtlesim turtlesim_node", "Spawning turtle"),
    ("sim", CTRL_C, ""),
    ("sim", "rosrun turtlesim turtlesim_node __name:=my_turtle", "Spawning turtle"),
    ("1", "rosnode cleanup\nrosnode list", "^/my_turtle"),
    ("1", "rosnode ping -c 1 my_turtle", "xmlrpc reply"),
    ("sim", CTRL_C, ""),
]
TOPICS = [
    ("sim", "rosrun turtlesim turtlesim_node", "Spawning turtle"),
    ("keys", in_a_tty("rosrun turtlesim turtle_teleop_key"), "Use arrow keys to move the turtle"),
    ("echo", "rostopic echo /turtle1/cmd_vel", ""),
    ("1", "cd; rosrun rqt_graph rqt_graph", "wrote .*rosgraph.png"),
    ("1", "rostopic -h", "rostopic bw"),
    # rostopic echo does not print that it has subscribed.
    ("1", "until rostopic list -v | grep '2 subscribers'; do sleep 0.1; done",
     r"/turtle1/cmd_vel \[geometry_msgs/Twist\] 2 subscribers"),
    ("keys", "\x1b[A", ""),
    ("echo", "", r"^  x: 2.0\n"),
    ("echo", CTRL_C, ""),
    ("keys", "q", "^ended-1007"),
    ("1", "rostopic type /turtle1/cmd_vel | rosmsg show", "Vector3 angular"),
    ("keys", f"rostopic pub -1 {CMD_VEL} -- '[2.0, 0.0, 0.0]' '[0.0, 0.0, 1.8]'", "3.0 seconds"),
    ("keys", f"rostopic pub {CMD_VEL} -r 1 -- '[2.0, 0.0, 0.0]' '[0.0, 0.0, -1.8]'", ""),
    ("echo", "rostopic echo /turtle1/pose", "angular_velocity: -1.79"),
    ("echo", CTRL_C, ""),
    ("echo", "rostopic hz /turtle1/pose", r"average rate: [56]\d\."),
    ("echo", CTRL_C, ""),
    ("keys", CTRL_C, ""),
]  # fmt: skip
SERVICES_AND_PARAMETERS = [
    ("1", "rosservice list", "^/turtle1/teleport_absolute"),
    ("1", "rosservice type /clear | rossrv show", "^---"),
    ("1", "rosservice type /spawn | rossrv show", "float32 theta"),
    ("1", 'rosservice call /spawn 2 2 0.2 ""', 'name: "turtle2"'),
    ("1", "rosparam list", "^/turtlesim/background_r"),
    ("1", "rosparam set /turtlesim/background_r 150\nrosservice call /clear", ""),
    ("1", "rosparam get /turtlesim/background_g", "^86"),
    ("1", "rosparam get /", "background_r: 150"),
    ("1", "rosparam dump params.yaml\nrosparam load params.yaml copy_turtle", ""),
    ("1", "rosparam get /copy_turtle/turtlesim/background_b", "^255"),
]
RQT_CONSOLE = [
    ("rqt", "rosrun rqt_console rqt_console", r"see http://127.0.0.1:80\d\d/#log"),
    ("keys", f"rostopic pub {CMD_VEL} -r 1 -- '{{linear: {{x: 2.0}}, angular: {{z: 0.0}}}}'", ""),
    ("1", "rosrun rqt_logger_level rqt_logger_level", "see .*/#log"),
    ("1", "rosrun rqt_plot rqt_plot", "see .*/#plot"),
    ("sim", "", "WARN.*wall"),
    ("keys", CTRL_C, ""),
    ("rqt", CTRL_C, ""),
    ("sim", CTRL_C, ""),
]
ROSLAUNCH = [
    ("1", "roscd beginner_tutorials\nmkdir launch config scripts", ""),
    *(("write", "beginner_tutorials/launch", path / "launch") for path in (SOLVED, WRITTEN)),
    ("write", "beginner_tutorials/config", WRITTEN / "config"),
    ("sim", "roslaunch beginner_tutorials turtlemimic.launch", r"process\[mimic-3\]"),
    ("keys", f"rostopic pub /turtlesim1{CMD_VEL} -r 1 -- '[2.0, 0.0, 0.0]' '[0.0, 0.0, -1.8]'", ""),
    ("echo", "rostopic echo /turtlesim2/turtle1/pose", "angular_velocity: -1.79"),
    ("1", "rqt_graph", "wrote .*rosgraph.png"),
    *((name, CTRL_C, "") for name in ("echo", "keys", "sim")),
]
ROSED = [
    ("1", "export EDITOR='true -w'\nrosed roscpp Logger.msg && echo edited", "^edited"),
    ("1", "rosed beginner_tutorials turtlemimic.launch && echo edited", "^edited"),
]
MESSAGES_AND_SERVICES = [
    ("1", 'mkdir msg srv\necho "int64 num" > msg/Num.msg', ""),
    ("1", r"printf 'int64 a\nint64 b\n---\nint64 sum\n' > srv/AddTwoInts.srv", ""),
    ("1", "rosmsg show beginner_tutorials/Num", "^int64 num"),
    ("1", "rossrv show AddTwoInts", r"^\[beginner_tutorials/AddTwoInts\]"),
]
PUBLISHER_AND_SERVER = [
    ("1", "roscd beginner_tutorials\ncd scripts", ""),
    ("1", "wget https://raw.github.com/talker.py", "type talker.py and listener.py"),
    ("write", "beginner_tutorials/scripts", TALKERS),
    ("write", "beginner_tutorials/scripts", SOLVED / "scripts"),
    ("1", f"chmod +x *.py\ncd {WS}\ncatkin_make", "SRV beginner_tutorials/AddTwoInts"),
    ("1", "python -c 'from beginner_tutorials.msg import Num; print(Num(5))'", "^num: 5"),
    ("sim", "rosrun beginner_tutorials add_two_ints_server.py", "ready to add"),
    ("1", "rosrun beginner_tutorials add_two_ints_client.py 1 3", r"1 \+ 3 = 4"),
    ("1", "rosservice call /add_two_ints 2 5", "sum: 7"),
    ("sim", CTRL_C, ""),
]
NAMES = [
    ("sim", "rosrun beginner_tutorials talker.py", TALKS),
    ("keys", "rosrun beginner_tutorials talker.py chatter:=/wg/chatter", TALKS),
    ("1", "rosnode list", r"^/talker_\d+_.*\n/talker_"),
    ("1", "rostopic echo -n 1 /wg/chatter", "data: .good day"),
    ("keys", CTRL_C, ""),
    ("sim", CTRL_C, ""),
    ("sim", "rosrun beginner_tutorials talker.py __name:=one __ns:=/wg _word:=5", TALKS),
    ("1", "rosparam get /wg/one/word", "^5"),
    ("keys", "rosrun beginner_tutorials talker.py __name:=one __ns:=/wg", TALKS),
    ("sim", "", "new node registered with same name"),
    ("keys", CTRL_C, ""),
]
LARGE = [
    ("sim", "ROBOT=sim roslaunch beginner_tutorials large.launch limit:=3", TALKS),
    ("1", "rosparam get /wg", "kernel: .Linux\n(.*\n)*limit: 30\n(.*\n)*rooms:\n- hall"),
    ("1", "rostopic echo -n 1 /wg/hello", "data: .good day"),
    ("sim", CTRL_C, ""),
]
JOYSTICK = [
    ("1", "ls /dev/input/", ""),
    ("1", "jstest /dev/input/js9", "No such file"),
    ("1", 'rosparam set joy_node/dev "/dev/input/js9"', ""),
    ("keys", "rosrun joy joy_node", "No joystick at /dev/input/js9"),
    ("keys", CTRL_C, ""),
    ("keys", in_a_tty("rosrun gamepad virtual_joystick --stream ~/js0"), "dead-man"),
    ("1", "rosparam set joy_node/dev ~/js0", ""),
    ("sim", "rosrun joy joy_node", "Opened joystick"),
    ("echo", "rostopic echo joy", "axes: "),
    ("keys", "w", ""),
    ("echo", "", r"axes: \[[^,]+, (1|0\.9)"),
    ("echo", CTRL_C, ""),
    ("sim", CTRL_C, ""),
    ("keys", "q", "^ended-1007"),
]
RECORDING = [
    ("sim", "rosrun turtlesim turtlesim_node", "Spawning turtle"),
    ("1", "mkdir ~/bagfiles\ncd ~/bagfiles", ""),
    ("echo", f"cd ~/bagfiles\n{RECORD} -a -O all", "to /turtle1/pose"),
    ("keys", f"rostopic pub {CMD_VEL} -r 5 -- '[2.0, 0.0, 0.0]' '[0.0, 0.0, 1.8]'", ""),
    ("echo", "", "Subscribing to /turtle1/cmd_vel"),
    ("1", "rostopic echo -n 6 /turtle1/cmd_vel", "z: 1.8"),
    ("keys", CTRL_C, ""),
    ("echo", CTRL_C, END),
    ("echo", f"{RECORD} -O subset /turtle1/cmd_vel /turtle1/pose", "to /turtle1/pose"),
    ("1", "rosbag info all.bag", r"/turtle1/cmd_vel +\d+ msgs? "),
    ("1", "rosbag play -r 2 all.bag < /dev/null", "Done."),
    ("echo", CTRL_C, END),
    ("sim", CTRL_C, ""),
    ("1", "rosbag info subset.bag", r"/turtle1/cmd_vel +\d+ msgs? "),
]
ROSWTF = [("1", "roscd rosmaster && roswtf", "rosdep2 --[^E]*Beginning tests")]


def uncomment_messages(package):
    """Edit catkin_create_pkg's files as the page on messages and services says."""
    path = package / "package.xml"
    comment = r"<!-- +(<(?:build|exec)_depend>message_\w+</\w+>) -->"
    path.write_text(re.sub(comment, r"\1", path.read_text()))
    path = package / "CMakeLists.txt"
    text = path.read_text().replace("  std_msgs\n", "  std_msgs\n  message_generation\n", 1)
    for kind, name in (("message", "Num.msg"), ("service", "AddTwoInts.srv")):
        block = rf"# (add_{kind}_files\()\n#   FILES\n(?:#   \w.*\n)+# \)"
        text = re.sub(block, rf"\1FILES {name})", text)
    text = re.sub(r"# (generate_messages\()\n#   (\w+)\n#   (\w+)\n# \)", r"\1\2 \3)", text)
    path.write_text(text.replace("#  CATKIN_DEPENDS roscpp", "  CATKIN_DEPENDS message_runtime"))


@claim("So can the pages of the wiki that it links, and those that follow them")
@pytest.mark.night  # test/check_bare_machine runs it at each commit
def test_the_pages_that_the_handout_links_from_their_first_command_to_the_last(student):
    student.do([*FILESYSTEM, *CREATING_A_PACKAGE, *WORKSPACES, *NODES, *TOPICS])
    student.do([*SERVICES_AND_PARAMETERS, *RQT_CONSOLE, *ROSLAUNCH, *ROSED])
    student.do(MESSAGES_AND_SERVICES)
    uncomment_messages(student.workspace / "src/beginner_tutorials")
    student.do([*PUBLISHER_AND_SERVER, *NAMES, *LARGE, *JOYSTICK, *RECORDING, *ROSWTF])
