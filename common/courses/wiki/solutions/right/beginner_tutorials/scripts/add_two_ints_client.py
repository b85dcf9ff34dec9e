#!/usr/bin/env python3
"""Ask for the sum of two numbers."""

import sys

import rospy
from beginner_tutorials.srv import AddTwoInts


def ask(x, y):
    rospy.wait_for_service("add_two_ints")
    add = rospy.ServiceProxy("add_two_ints", AddTwoInts)
    return add(x, y).sum


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(f"usage: {sys.argv[0]} x y")
    x, y = int(sys.argv[1]), int(sys.argv[2])
    print(f"{x} + {y} = {ask(x, y)}")
