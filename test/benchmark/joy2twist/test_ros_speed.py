"""The running node beside a bare rospy relay, in one run. Its figures are in the package's README.

Ratios, because they hold on any machine; the relays take turns, because machines change.
"""

import statistics
from pathlib import Path

from live import JOY2TWIST, QUIET, delays, master, running

RELAYS = {"bare": [str(Path(__file__).with_name("bare_relay.py"))], "ours": JOY2TWIST}
LOADS = {50: 250, 1000: 4000}  # rate [Hz]: messages
ROUNDS = 3
MOST = {50: 1.1, 1000: 1.5}  # times the median latency through a bare relay, which sleeps more


def measured(command, rate, count):
    """Return median and 99th percentile of the latency [us]."""
    with running(command, **QUIET):
        took_s = delays("joy", rate, count)
    return [1e6 * took_s[len(took_s) // 2], 1e6 * took_s[len(took_s) * 99 // 100]]


def test_latency_beside_a_bare_relay(figure):
    late = []
    with master():
        for load in LOADS.items():
            rounds = {name: [] for name in RELAYS}
            for _ in range(ROUNDS):
                for name, command in RELAYS.items():
                    rounds[name].append(measured(command, *load))
            bare, ours = ([statistics.median(each) for each in zip(*rounds[n])] for n in RELAYS)
            for part, least, mine in zip(("median", "99 of 100"), bare, ours):
                demanded = f"< {MOST[load[0]]}" if part == "median" else ""
                figure(f"{load[0]} Hz, {part}", f"{mine:.0f} us ({mine / least:.2f})", demanded)
            late += [load] if ours[0] >= MOST[load[0]] * bare[0] else []
    assert not late
