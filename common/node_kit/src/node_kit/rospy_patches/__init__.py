"""What is changed inside rospy, from outside: the README of node_kit has each with its reason."""
