"""The cockpit in a browser, beside a robot whose odometry tells what is true."""
