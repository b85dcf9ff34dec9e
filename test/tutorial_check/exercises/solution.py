"""The literal solution: its files, and the lines that rows change."""

B, J = "beginner_tutorials", "joy2twist"
XML, JOY_XML = f"{B}/package.xml", f"{J}/package.xml"
CMAKE, JOY_CMAKE = f"{B}/CMakeLists.txt", f"{J}/CMakeLists.txt"
JOY_BAG = f"{J}/bag/joy.bag"
TALKER, LISTENER = f"{B}/scripts/talker.py", f"{B}/scripts/listener.py"
JOY2TWIST, CLASS = f"{J}/scripts/joy2twist.py", f"{J}/scripts/new_joy2twist.py"
LAUNCH_BAG, LAUNCH_JOY = f"{J}/launch/launch_bag.launch", f"{J}/launch/launch_joy_node.launch"
TURTLEBOT = f"{J}/launch/joy2twist_turtlebot.launch"
REAL = f"{J}/launch/launch_joy_node_realTurtlebot.launch"
SHOW = 'rospy.loginfo(rospy.get_name() + ": axes [%.2f, %.2f, %.2f, %.2f, %.2f, %.2f]" % data.axes)'
X, Z = "msg.linear.x = data.axes[1]", "msg.angular.z = data.axes[0]"
PUBLISH = "pub.publish(msg)"
SUB = 'rospy.Subscriber("/joy", Joy, callback)'
REMAP = '<remap from="/cmd_vel" to="/cmd_vel_mux/input/teleop"/>'
