"""The cockpit in a browser, beside a robot whose odometry is the truth."""
