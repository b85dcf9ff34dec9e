"""The tutorial's handout, typed word for word by a student with a new workspace.

Rows in the handout's order: the terminal, what is typed there, and a pattern of its output, which
comes from none of our solutions.
"""

import re

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY
from tutorial_testing.waiting import wait_for

# Programs and launch files like the handout's: env python, load_manifest, absolute topics, no
# queue_size, six axes in one format; but in our own words.
LITERAL = REPOSITORY / "test/tutorial_check/exercises/literal"
PACKAGES = [
    ("1", "cd ~/ros/hydro/catkin_ws/src", ""),
    ("1", "catkin_create_pkg beginner_tutorials std_msgs rospy roscpp", "Successfully created"),
    ("1", "cd ~/ros/hydro/catkin_ws/\ncatkin_make", "beginner_tutorials"),
    ("1", "rospack profile", "Full tree crawl"),
    ("1", "roscd beginner_tutorials\npwd", "/src/beginner_tutorials"),
    ("1", "mkdir scripts\ncd scripts", ""),
    ("write", "beginner_tutorials/scripts", LITERAL / "beginner_tutorials/scripts"),
    ("1", "chmod +x talker.py\nchmod +x listener.py", ""),
    ("1", "cd ~/ros/hydro/catkin_ws/\ncatkin_make", "Running command"),
]
TALK = [
    ("roscore", "roscore", "started core service"),
    ("2", "rosrun beginner_tutorials talker.py", r"\[INFO\]"),
    ("3", "rosrun beginner_tutorials listener.py", r"\[INFO\].*heard"),
    ("1", "cd /tmp && rqt_graph", "wrote /tmp/rosgraph.png"),
    ("1", "rosnode list", "/talker_"),
]
JOY = [
    ("1", 'cp "$(rospack find gamepad)/bag/joy.bag" ~\ncd ~', ""),
    ("1", "rqt_bag joy.bag", "rosbag play --loop joy.bag"),
    ("bag", "cd ~ && rosbag play --loop joy.bag", "Duration"),
    ("1", "rostopic echo -n 1 /joy/axes[0]", r"^-?\d"),
    ("1", "cd ~/ros/hydro/catkin_ws/src", ""),
    ("1", "catkin_create_pkg joy2twist rospy std_msgs sensor_msgs geometry_msgs", "Successfully"),
    ("1", "cd ~/ros/hydro/catkin_ws && catkin_make", "joy2twist"),
    ("1", "rospack profile", "Full tree crawl"),
    ("1", "roscd joy2twist\nmkdir scripts\ncd scripts", ""),
    ("write", "joy2twist/scripts", LITERAL / "joy2twist/scripts"),
    ("1", "chmod +x joy2twist.py new_joy2twist.py", ""),
    ("4", "rosrun joy2twist joy2twist.py", r"listener_\S*: axes \["),
    ("1", "rostopic echo -n 1 /cmd_vel", "linear"),
    ("5", "roslaunch rbx1_bringup fake_turtlebot.launch", "started with pid"),
    ("1", "rostopic echo -n 1 /odom/pose/pose/position", "x: "),
    ("1", "ls `rospack find rbx1_nav`/sim.rviz", "^/.*/sim.rviz"),
    ("6", "rosrun joy joy_node", "No joystick at /dev/input/js0"),
]
LAUNCH = [
    ("1", "roscd joy2twist\nmkdir launch\ncd launch", ""),
    ("write", "joy2twist/launch", LITERAL / "joy2twist/launch"),
    ("1", "mkdir ../bag && cp ~/joy.bag ../bag", ""),
    ("7", "roscd joy2twist/launch && roslaunch launch_bag.launch", "myjoystick2twist"),
    ("1", "rostopic echo -n 1 /odom/twist/twist/linear", "x: "),
    ("1", "roslaunch --files joy2twist launch_bag.launch", "rbx1_bringup/launch/fake_turtlebot"),
]
TURTLEBOT = [
    ("8", "roslaunch turtlebot_bringup minimal.launch", "started with pid"),
    ("9", "roslaunch joy2twist joy2twist_turtlebot.launch", "started with pid"),
    ("1", "ls `rospack find turtlebot_rviz_launchers`/launch", "view_robot.launch"),
]


def nothing_of_ours(student):
    """Return whether the student's terminals find no file of the solutions."""
    packages = ("joy2twist", "beginner_tutorials")
    paths = "".join(student.run(f"rospack find {name}; catkin_find {name}") for name in packages)
    return not any(f"{REPOSITORY}/{name}" in paths for name in packages)


@claim("The handout can be typed word for word; nothing of our solutions is found")
@pytest.mark.long
def test_the_handout_from_its_first_command_to_its_last_and_its_check(student):
    student.do(PACKAGES)
    assert nothing_of_ours(student)
    student.do(TALK)
    student.close("2", "3")
    student.do(JOY)
    student.close("4", "5", "6", "bag")
    student.do(LAUNCH)
    assert nothing_of_ours(student)
    student.close("7")
    student.do(TURTLEBOT)
    info = "rostopic info /cmd_vel_mux/input/teleop"
    wait_for(lambda: "/myjoystick2twist" in student.run(info), "joy2twist at the robot")
    assert f"{student.workspace}/src/joy2twist" in student.run("tutorial doctor")
    student.close()
    said = student.run("cd / && tutorial check 2")
    assert re.search(r"ok +C1 .*on top of this suite", said), said
    assert "1 of 1 exercises done" in said
