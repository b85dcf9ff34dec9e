#!/usr/bin/python3
"""Run the tests of a Python file, test/PACKAGE/ros/NAME.py, as a node: one.py NAME."""

import sys
from pathlib import Path

import rostest

from tutorial_testing.nodes import init_node

name = sys.argv[1]
(file,) = Path(__file__).resolve().parents[1].glob(f"*/ros/{name}.py")
sys.path.insert(0, str(file.parent))
init_node(name)
rostest.rosrun("ros1_tutorial_test", name, name, sys.argv)
