"""What concerns the process of roslaunch: its command line, its end."""
