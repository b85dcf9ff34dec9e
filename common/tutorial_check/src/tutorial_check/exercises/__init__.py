"""The exercises of the handout, their checks in order, and the function that makes each."""

from tutorial_check.model import Catalogue, Check

# What the student reads: the number in the handout, and what it is about.
EXERCISES = {
    "2": "a package",
    "3": "talker and listener",
    "4.2": "the topic /joy",
    "4.3": "joy2twist",
    "4.4": "the simulated robot",
    "4.5": "a joystick",
    "5": "launch files",
    "6.1": "remapping",
    "6.2": "a class",
}

CHECKS = (
    Check("C1", "2", "the workspace", "2.1", (), "ls src devel", timeless=True),
    Check("C2", "2", "package beginner_tutorials", "2.1", (), "rospack find beginner_tutorials", timeless=True),
    Check("C3", "2", "its dependencies", "2.1", ("C2",), "rospack depends1 beginner_tutorials", timeless=True),
    Check("C4", "2", "catkin_make builds", "2.1", ("C2",), "catkin_make"),
    Check("C5", "3", "talker.py and listener.py can be run", "3.1", ("C2",), "rosrun beginner_tutorials talker.py", timeless=True),
    Check("C6", "3", "the talker talks", "3.1", ("C5",), "rostopic hz /chatter"),
    Check("C7", "3", "the listener displays what it hears", "3.1", ("C5",), "rosrun beginner_tutorials listener.py"),
    Check("C8", "3", "talker and listener are connected", "3.1", ("C6", "C7"), "rosnode info /rosout; rqt_graph"),
    Check("C9", "3", "anonymous names", "3.1", ("C6", "C7", "C10"), "rosnode list, with two talkers"),
    Check("C10", "3", "Ctrl-C ends both", "3.1", ("C6", "C7"), "Ctrl-C in their terminals"),
    Check("C11", "4.2", "a recording of /joy", "4.2", (), "rosbag info joy.bag"),
    Check("C12", "4.3", "package joy2twist and its dependencies", "4.3", (), "rospack find joy2twist", timeless=True),
    Check("C13", "4.3", "joy2twist.py can be run", "4.3", ("C12",), "rosrun joy2twist joy2twist.py", timeless=True),
    Check("C14", "4.3", "it displays every Joy", "4.3", ("C13",), "rosrun joy2twist joy2twist.py; rostopic echo /joy"),
    Check("C15", "4.3", "/joy in, /cmd_vel out", "4.3", ("C13",), "rosnode info NODE"),
    Check("C16", "4.3", "axis 1 drives forwards, axis 0 turns", "4.3", ("C15",), "rostopic echo /cmd_vel"),
    Check("C17", "4.3", "it keeps up with the joystick", "4.3", ("C16",), "rostopic hz /cmd_vel"),
    Check("C18", "4.3", "it starts while the joystick speaks", "4.3", ("C16",), "rosbag play --loop joy.bag; rosrun joy2twist joy2twist.py"),
    Check("C34", "4.3", "Ctrl-C ends it", "4.3", ("C16",), "Ctrl-C in its terminal"),
    Check("C19", "4.4", "the simulated robot follows", "4.4", ("C16",), "rostopic echo /odom/pose/pose/position"),
    Check("C20", "4.5", "a joystick drives it", "4.5", ("C16",), "rostopic echo /joy/axes[1]"),
    Check("C21", "5", "the two launch files can be read", "5.1", ("C12",), "roslaunch --nodes joy2twist launch_bag.launch", timeless=True),
    Check("C22", "5", "launch_bag starts the four items", "5.1", ("C21",), "roslaunch --nodes joy2twist launch_bag.launch", timeless=True),
    Check("C23", "5", "launch_bag drives the robot", "5.1", ("C22", "C16"), "roslaunch joy2twist launch_bag.launch"),
    Check("C24", "5", "the recording begins again at its end", "5.1", ("C23",), "rostopic hz /joy"),
    Check("C25", "5", "launch_joy_node starts the four items", "5.1", ("C21",), "roslaunch --nodes joy2twist launch_joy_node.launch", timeless=True),
    Check("C26", "5", "launch_joy_node drives the robot", "5.1", ("C25", "C16"), "roslaunch joy2twist launch_joy_node.launch"),
    Check("C27", "6.1", "joy2twist_turtlebot sends to the multiplexer", "6.1", ("C16",), "rostopic echo /cmd_vel_mux/input/teleop"),
    Check("C28", "6.1", "launch_joy_node_realTurtlebot drives the TurtleBot", "6.1", ("C27",), "rostopic echo /cmd_vel_mux/active"),
    Check("C29", "6.2", "the program is a class", "6.2", ("C12",), "rosrun joy2twist THE_CLASS", timeless=True),
    Check("C30", "6.2", "the class does what the functions did", "6.2", ("C29",), "rostopic echo /cmd_vel"),
    Check("C31", "6.2", "ended, it stops the robot", "6.2", ("C30",), "rostopic echo /cmd_vel; Ctrl-C in the node's terminal"),
    Check("C32", "6.2", "nothing follows the zero", "6.2", ("C31",), "rostopic echo /cmd_vel"),
    Check("C33", "6.2", "its errors are seen", "6.2", ("C30",), "rosrun joy2twist THE_CLASS, without a joystick"),
)  # fmt: skip


def catalogue():
    """The Catalogue of all checks. Loads ROS."""
    from tutorial_check.exercises import (  # noqa: PLC0415  the command line needs no ROS
        chatter,
        classes,
        ending,
        floor,
        hidden_errors,
        joy2twist,
        launch_files,
        launch_nodes,
        launch_runs,
        packages,
        robot,
        turtlebot,
    )

    functions = {
        "C1": floor.workspace, "C2": packages.beginner, "C3": packages.beginner_dependencies,
        "C4": packages.build, "C5": chatter.files, "C6": chatter.talker, "C7": chatter.listener,
        "C8": chatter.graph, "C9": chatter.anonymous, "C10": chatter.ctrl_c,
        "C11": robot.recording, "C12": packages.joy2twist, "C13": joy2twist.file,
        "C14": joy2twist.displays, "C15": joy2twist.topics, "C16": joy2twist.mapping,
        "C17": joy2twist.rate, "C18": joy2twist.under_load, "C34": joy2twist.ctrl_c, "C19": robot.simulated,
        "C20": robot.joystick, "C21": launch_files.files, "C22": launch_nodes.bag_nodes,
        "C23": launch_runs.bag_drives, "C24": launch_runs.bag_loops, "C25": launch_nodes.stick_nodes,
        "C26": launch_runs.stick_drives, "C27": turtlebot.remapped, "C28": turtlebot.real_robot,
        "C29": classes.is_class, "C30": classes.behaves, "C31": ending.stops,
        "C32": ending.nothing_after, "C33": hidden_errors.errors_are_seen,
    }  # fmt: skip
    return Catalogue(CHECKS, functions)
