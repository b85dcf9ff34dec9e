"""Sends random Joy messages over the wire, and watches the velocities that come of them.

    fuzzer.py SEED COUNT

Lines: `sent NUMBER`, every now and then; `bad WORDS` for a velocity that must not be; `done`.
"""

import sys
import threading
import time
from random import Random

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_faults.events import Twist as Asked
from tutorial_faults.invariants import WithinLimits, moves
from tutorial_faults.live.judge import MAX_ANGULAR, MAX_LINEAR
from tutorial_faults.live.random_bytes import broken_joy, joy

BLOCK = 5000  # messages that may hold the dead-man, and then as many that do not
BURST = 25  # messages in one write: less than joy2twist keeps
BROKEN_EACH = 2000  # one message of so many cannot be read; the connection is made anew for each
# From one block to the next all that is under way arrives: so long nothing has moved, and at the
# latest after so long, on a busy machine.
SETTLES_S, LONGEST_S = 1.0, 60.0


class Watch:
    """Judges the velocities of joy2twist."""

    def __init__(self):
        """Nothing is held."""
        self.may_move = False
        self.moved_s = 0.0  # when it last moved
        self._limits = WithinLimits(MAX_LINEAR, MAX_ANGULAR)

    def take(self, twist):
        """Take a geometry_msgs/Twist."""
        linear, angular = twist.linear, twist.angular
        velocity = (linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
        wrong = self._limits.take(Asked(time.time(), velocity))
        if wrong:
            print(f"bad (c) {wrong.what}", flush=True)
        if moves(velocity):
            self.moved_s = time.monotonic()
            if not self.may_move:
                print(f"bad (a) {velocity} without a dead-man held", flush=True)

    def settle(self):
        """Return when nothing has moved for a while; from then on nothing may."""
        began_s = now_s = time.monotonic()
        while now_s - max(began_s, self.moved_s) < SETTLES_S and now_s - began_s < LONGEST_S:
            time.sleep(0.05)
            now_s = time.monotonic()
        self.may_move = False


def sockets(publisher):
    """The sockets of those who listen, without rospy's way of sending."""
    return [connection._connection.socket for connection in publisher.impl.connections]


def send(publisher, data):
    """Send bytes to all who listen; wait for one to listen."""
    while True:
        listeners = [one for one in sockets(publisher) if one]
        if listeners:
            break
        time.sleep(0.01)
    for one in listeners:
        try:
            one.sendall(data)
        except OSError:
            pass  # it has had enough, and comes again


def main():
    """Send all, and end with the standard input."""
    seed, count = map(int, sys.argv[1:])
    random = Random(seed)
    rospy.init_node("stranger_fuzzer", disable_signals=True, disable_rosout=True)
    watch = Watch()
    rospy.Subscriber("cmd_vel_mux/input/teleop", Twist, watch.take, queue_size=1000)
    publisher = rospy.Publisher("joy", Joy, queue_size=1)
    print("ready", flush=True)
    threading.Thread(target=fuzz, args=(random, count, watch, publisher), daemon=True).start()
    sys.stdin.read()


def fuzz(random, count, watch, publisher):
    """Send so many messages."""
    sent = 0
    while sent < count:
        holds = sent // BLOCK % 2 == 0
        if sent % BLOCK == 0:
            if holds:
                watch.may_move = True
            else:
                send(publisher, joy(random, False))
                watch.settle()
            print("sent", sent, flush=True)
        if sent % BROKEN_EACH < BURST:
            send(publisher, broken_joy(random))
        send(publisher, b"".join(joy(random, holds) for _ in range(BURST)))
        sent += BURST
    print("sent", sent, flush=True)
    print("done", flush=True)


if __name__ == "__main__":
    main()
