"""Which Debian package has a Python module or a ROS package, and what Debian lacks. Pure.

The names are those that Debian 12 and 13 share, by `apt-cache dumpavail`: python3-* and lib*-dev of
the sources ros-*, with the modules and package.xml that `dpkg -c` shows; and what programs for the
TurtleBot import besides. test/system/test_other_programs.py asks apt for each.
"""

from __future__ import annotations

import fnmatch

# Python modules, each in python3-NAME, with - in place of _.
MODULES = """
actionlib actionlib_msgs angles bondpy bson camera_calibration cv_bridge dynamic_reconfigure evdev
gi image_geometry interactive_markers laser_geometry lxml map_msgs matplotlib message_filters
move_base_msgs networkx nodelet pandas pcl_msgs pexpect psutil pyaudio pygame pynput pyqtgraph
requests resource_retriever rviz scipy serial shape_msgs shapely stereo_msgs tf tf2_geometry_msgs
tf2_kdl tf2_ros tf2_sensor_msgs tf_conversions topic_tools tornado trajectory_msgs transforms3d
twisted usb websocket yaml zmq
"""
# Python modules in packages of another name; {} is the module's.
OTHER_MODULES = """
PIL Image: python3-pil
PyKDL PyQt5 Xlib: python3-{}
wx: python3-wxgtk4.0
Tkinter tkinter: python3-tk
bluetooth: python3-bluez
cv2: python3-opencv
roscpp: python3-roscpp-msg
tf2_py: python3-tf2
"""
# ROS packages whose package.xml, headers and CMake files are in libNAME-dev.
DEV_PACKAGES = """
actionlib angles bond bondcpp class_loader cv_bridge depth_image_proc diagnostic_aggregator
diagnostic_updater image_geometry image_proc interactive_markers kdl_parser laser_geometry map_msgs
move_base_msgs pcl_conversions pcl_msgs pcl_ros random_numbers resource_retriever shape_msgs
stereo_image_proc stereo_msgs tf2 tf2_eigen tf2_geometry_msgs tf2_kdl tf2_ros tf2_sensor_msgs
tf_conversions trajectory_msgs urdf visualization_msgs
"""
# ROS packages in other packages, or in two, as nodes are often apart; {} is the name.
OTHER_PACKAGES = """
camera_calibration message_generation message_runtime robot_state_publisher: ros-{}
dynamic_reconfigure: libdynamic-reconfigure-config-init-mutex-dev python3-dynamic-reconfigure
image_transport: lib{}-dev {}-tools
image_view: lib{}-dev ros-{}
joint_state_publisher* rviz tf2_tools: {}
nodelet: libnodeletlib-tools
pluginlib: {}-dev
tf: lib{}-dev {}-tools
topic_tools: lib{}-dev {}
"""
# ROS packages that Debian lacks, and what to do here; the first pattern that fits counts.
LACKING = """
turtlebot3_*: that is another robot; here is a TurtleBot 2
xacro turtlebot_description kobuki_description: the simulated robot has its model already
arbotix* rbx1* rbx2*: fake_turtlebot.launch of rbx1_bringup is here, and needs no arbotix
*gazebo* *stage* hector_*: the simulator here is fake_turtlebot_sim, with world:=room
map_server: fake_turtlebot_sim with world:=MAP.yaml publishes /map
move_base amcl gmapping *navigation* costmap_2d navfn dwa_*: there is no navigation stack here
robot_pose_ekf robot_localization: take /odom
rqt*: rqt_plot, rqt_console, rqt_graph and others are here; `./tutorial cockpit` shows the same
openni* freenect* astra* depthimage_to_laserscan *_cam: with a world:= there is /scan, but no camera
teleop_twist_joy joystick_drivers: joy2twist and joy_node of the package joy are here
teleop_twist_keyboard: copy its one file into your package
turtlebot_* kobuki_*: common/doc/OTHER_PROGRAMS.md lists what is here
turtle_tf* turtle_actionlib: turtlesim is here; write its followers as the tutorials show
rosbridge* web_video_server: `./tutorial cockpit` shows the robot in a browser
roslint: take it out of CMakeLists.txt and package.xml: it only checks style
rosserial* smach* moveit* sound_play ar_track_alvar* *_controllers ecl_*: nothing replaces it here
"""


def _found(table: str, name: str) -> str:
    """Return what a table has after the first pattern that fits a name, its {} filled in; or ""."""
    for row in table.strip().splitlines():
        names, _, words = row.partition(": ")
        if any(fnmatch.fnmatchcase(name, each) for each in names.split()):
            return words.replace("{}", name.lower().replace("_", "-"))
    return ""


def package_of_module(module: str) -> str:
    """Return the Debian package that has a Python module, or ""."""
    top = module.partition(".")[0]
    return _found(f"{top}: python3-{{}}" if top in MODULES.split() else OTHER_MODULES, top)


def packages_of_ros(name: str) -> str:
    """Return the Debian packages, with blanks between, that have a ROS package; or ""."""
    table = f"{name}: lib{{}}-dev" if name in DEV_PACKAGES.split() else OTHER_PACKAGES
    return _found(table, name) or package_of_module(name)


def in_place_of(name: str) -> str:
    """Return what to do without a ROS package, or module, that Debian lacks; or ""."""
    return _found(LACKING, name)


def advice(name: str, packages: str) -> str:
    """Return what to do about what is not installed, and is in these packages of Debian's; or ""."""
    other = in_place_of(name)
    lacks = f"Debian lacks {name}; {other}" if other else ""
    return f"Debian has it: sudo apt install {packages}" if packages else lacks
