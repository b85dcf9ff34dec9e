"""The running node beside a bare rospy relay, in one run. Its figures are in the package's README.

Ratios, because they hold on any machine; the relays take turns, because machines change.
"""

import json
import statistics
import subprocess
import sys
from pathlib import Path

from live import master, processor_time, running

HERE = Path(__file__).parent
BARE, OURS = "bare rospy relay", "joy2twist.py, all safety on"
RELAYS = {
    BARE: [str(HERE / "bare_relay.py")],
    OURS: [
        "rosrun", "joy2twist", "joy2twist.py", "_enable_button:=4", "_enable_turbo_button:=5",
        "_arm_on_neutral:=true", "_max_joy_age:=0.5", "_max_linear_speed:=5.0",
        "_max_angular_speed:=5.0",
    ],
}  # fmt: skip
LOADS = {50: 250, 1000: 4000}  # rate [Hz]: messages
ROUNDS = 3
MOST = 1.5  # times the latency through a bare relay


def measured(command, rate, count):
    """Return median and 99th percentile of the latency, processor time of a message [us]."""
    probe = [sys.executable, str(HERE / "probe.py"), str(rate), str(count)]
    with running(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as relay:
        used_s = processor_time(relay.pid)
        done = subprocess.run(probe, stdout=subprocess.PIPE, text=True, check=True, timeout=120)
        used_s = processor_time(relay.pid) - used_s
    heard = json.loads(done.stdout)
    assert heard["newest"], "the newest is not answered"
    latency_s = heard["latency_s"]
    times_s = latency_s[len(latency_s) // 2], latency_s[len(latency_s) * 99 // 100], used_s / count
    return [1e6 * time_s for time_s in times_s]


def test_latency_and_processor_time_beside_a_bare_relay(figure):
    late = []
    with master():
        for load in LOADS.items():
            rounds = {name: [] for name in RELAYS}
            for _ in range(ROUNDS):
                for name, command in RELAYS.items():
                    rounds[name].append(measured(command, *load))
            bare, ours = ([statistics.median(each) for each in zip(*rounds[n])] for n in RELAYS)
            parts = ("median", "99 of 100", "processor time of a message")
            for part, least, mine in zip(parts, bare, ours):
                demanded = f"< {MOST}" if part == "median" else ""
                figure(f"{load[0]} Hz, {part}", f"{mine:.0f} us ({mine / least:.2f})", demanded)
            late += [load] if ours[0] >= MOST * bare[0] else []
    assert not late
