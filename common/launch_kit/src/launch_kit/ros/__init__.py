"""What reads launch files as roslaunch does, and asks the master which nodes run."""
