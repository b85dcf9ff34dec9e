#!/usr/bin/python3
"""Time numbered messages until each is answered. probe.py KIND RATE COUNT -> JSON: times [s].

It first prints "ready", when everything is connected and warm.

KIND: joy or, for inputs of a cockpit page, page:PORT:TOKEN, both answered by a Twist; or cmd_vel,
answered by an Odometry.
"""

import gc
import json
import sys
import time

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from tutorial_testing.socket_page import SocketPage

# Stick or speed: the first value, and the step between messages; exact as float32.
FIRST, STEP = 2.0**-3, 2.0**-14
WARM_PERIOD_S = 0.02
kind, rate, count = sys.argv[1], float(sys.argv[2]), int(sys.argv[3])
heard_s = {}  # time of the answer to each number


def hand(number, held):
    """Return (axes, buttons) of a stick, with LB held or not."""
    return [0.0, FIRST + number * STEP if held else 0.0, 0, 0, 0, 0], [0, 0, 0, 0, held] + [0] * 7


def publishing(topic, message_type, fill):
    """Return a function (number, held) that publishes what fill() makes of a message."""
    publisher = rospy.Publisher(topic, message_type, queue_size=1)
    publisher.impl.set_queue_size(None)
    while not publisher.get_num_connections():
        time.sleep(0.01)
    message = message_type()

    def send(number, held=1):
        fill(message, number, held)
        publisher.publish(message)

    return send


def fill_joy(joy, number, held):
    joy.header.stamp = rospy.Time.now()
    joy.axes, joy.buttons = hand(number, held)


def fill_twist(twist, number, held):
    twist.linear.x = FIRST + number * STEP


def of_page(port, token):
    """Return a function (number, held) of a page that drives; it takes the seat again if needed."""
    page = SocketPage(port, token).__enter__()
    page.wait_for("drives", lambda message: not message["refusal"])  # the page knows the robot

    def send(number, held=1):
        sessions = page.of("session")
        if not (sessions and sessions[-1]["yours"] and sessions[-1]["armed"]):
            page.sit_down()  # at first, and when a busy machine has lost the operator
            page.hand = None
        page.say(**page.input(*hand(number, held)))

    return send


def answered(twist):
    heard_s.setdefault(round((twist.linear.x - FIRST) / STEP), time.monotonic())


rospy.init_node("probe", disable_signals=True)
if kind == "cmd_vel":
    hear = lambda odometry: answered(odometry.twist.twist)  # noqa: E731
    rospy.Subscriber("odom", Odometry, hear, tcp_nodelay=True)
    ask = publishing("cmd_vel", Twist, fill_twist)
else:
    rospy.Subscriber("cmd_vel", Twist, answered, tcp_nodelay=True)
    ask = of_page(*kind.split(":")[1:]) if ":" in kind else publishing("joy", Joy, fill_joy)
gc.freeze()
for _ in range(10):  # released first, for a node with arming
    ask(0, held=0)
    time.sleep(WARM_PERIOD_S)
while count + 1 not in heard_s:  # until everything is connected and warm
    ask(count + 1)
    time.sleep(WARM_PERIOD_S)
print("ready", flush=True)
sent_s, start_s = {}, time.monotonic()
for number in range(1, count + 1):
    time.sleep(max(0.0, start_s + number / rate - time.monotonic()))
    sent_s[number] = time.monotonic()
    ask(number)
deadline_s = time.monotonic() + 5
while count not in heard_s and time.monotonic() < deadline_s:
    time.sleep(0.01)
if count not in heard_s:
    sys.exit("probe.py: the last message was not answered")
print(json.dumps(sorted(heard_s[n] - when for n, when in sent_s.items() if n in heard_s)))
