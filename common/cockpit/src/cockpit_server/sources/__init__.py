"""What pages see: the Sources, most of them for one tab, and their recordings. They may use ROS."""
