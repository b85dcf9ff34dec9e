"""What the packages of the exercises depend on."""

WANTED = {
    "beginner_tutorials": ("std_msgs", "rospy", "roscpp"),
    "joy2twist": ("rospy", "std_msgs", "sensor_msgs", "geometry_msgs"),
}
