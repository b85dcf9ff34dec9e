#!/usr/bin/python3
"""Run the tests of a Python file in a folder beside this one, as a node: one.py NAME."""

import sys
from pathlib import Path

import rostest

from tutorial_testing.nodes import init_node

name = sys.argv[1]
(file,) = Path(__file__).resolve().parent.glob(f"*/{name}.py")
sys.path.insert(0, str(file.parent))
init_node(name)
rostest.rosrun("ros1_tutorial_test", name, name, sys.argv)
