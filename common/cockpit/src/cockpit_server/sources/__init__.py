"""What pages see: each module is a Source, most of them a tab. They may know ROS."""
