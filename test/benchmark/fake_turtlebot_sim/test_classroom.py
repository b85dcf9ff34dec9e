"""A classroom: thirty robots, ten of them driven from a recording by students, all topics heard."""

import os
from xmlrpc.client import ServerProxy

from live import FAKE_TURTLEBOT, HERE, lost_periods, master, observe, topics_of

ROBOTS, SECONDS = 30, 20
DRIVEN = [f"robot_{number}" for number in range(1, 11)]
BAG = HERE.parents[2] / "joy2twist" / "bag" / "joy.bag"
TOPICS = topics_of(ROBOTS, "odom", "joint_states")
STUDENTS = [f"/{name}/{topic}" for name in DRIVEN for topic in ("joy", "cmd_vel")]
OPTIONS = [f"bag:={BAG}", "loop:=true", "rviz:=false"]


def test_a_classroom(figure):
    students = [
        ["roslaunch", "joy2twist", "student.launch", f"name:={name}", *OPTIONS] for name in DRIVEN
    ]
    with master():
        # As the first roslaunch sets it; ten at once would compete for being the first.
        ServerProxy(os.environ["ROS_MASTER_URI"]).setParam("/classroom", "/run_id", "classroom")
        simulator = [*FAKE_TURTLEBOT, f"_robots:={ROBOTS}"]
        heard, loads = observe([simulator, *students], [*TOPICS, *STUDENTS], SECONDS)
    rate = sum(len(record["arrivals"]) for record in heard.values()) / SECONDS
    lost = lost_periods({topic: heard[topic] for topic in TOPICS})
    what = f"classroom: {ROBOTS} robots, {len(DRIVEN)} of them driven"
    figure(what, f"{rate:,.0f} messages/s, {lost} periods lost", "0")
    each = sum(loads[1:]) / len(DRIVEN)
    figure("processor time: simulator; a student", f"{loads[0]:.0%}; {each:.1%}", "")
    assert lost == 0
