"""ROS Noetic's metapackages, from https://ros.org/reps/rep-0150.html and their package.xml."""

META = {
    "ros_base": "ros_core actionlib bond_core class_loader dynamic_reconfigure nodelet_core"
    " pluginlib",
    "ros_core": "catkin cmake_modules common_msgs gencpp geneus genlisp genmsg gennodejs genpy"
    " message_generation message_runtime ros ros_comm ros_environment rosbag_migration_rule"
    " rosconsole_bridge roscpp_core rosgraph_msgs roslisp rospack std_msgs std_srvs",
    "ros": "catkin mk rosbash rosboost_cfg rosbuild rosclean roscreate roslang roslib rosmake"
    " rosunit",
    "ros_comm": "message_filters ros rosbag rosconsole roscpp rosgraph rosgraph_msgs roslaunch"
    " roslisp rosmaster rosmsg rosnode rosout rosparam rospy rosservice rostest rostopic roswtf"
    " std_srvs topic_tools xmlrpcpp",
    "common_msgs": "actionlib_msgs diagnostic_msgs geometry_msgs nav_msgs sensor_msgs shape_msgs"
    " stereo_msgs trajectory_msgs visualization_msgs",
}
