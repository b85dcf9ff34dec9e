"""The running node compared with a bare rospy relay; the package's README has the figures.

It compares ratios, which hold on any machine, round by round, because the machine's load changes.
"""

from pathlib import Path
from statistics import median

import pytest
from live import JOY2TWIST, QUIET, delays_and_processor, master, running

from tutorial_testing.claims import claim

ALL_SAFETY = [*JOY2TWIST, "_joy_timeout:=0.5", "_vigilance_timeout:=3.0"]
# Only the node alone displays the axes, like the tutorial's; the gamepad's launch files do not.
NODES = {"": [*ALL_SAFETY, "_log_rate:=0"], ", axes displayed": ALL_SAFETY}
BARE = [str(Path(__file__).with_name("bare_relay.py"))]
ROUNDS = 9
PARTS = ("median", "99 of 100", "processor time per message")


@claim("joy2twist's figures of delay, beside a bare relay")
@pytest.mark.parametrize(
    # most: times the median delay, and the processor time, of the bare relay
    ("rate", "count", "shows", "most"),
    [(50, 250, "", {"median": 1.2, PARTS[2]: 1.3}),
     (50, 250, ", axes displayed", {"median": 1.2}),
     (1000, 4000, "", {"median": 1.5, PARTS[2]: 1.3})],
)  # fmt: skip
def test_delay_and_processor_time_beside_a_bare_relay(figure, rate, count, shows, most):
    relays = BARE, NODES[shows]
    with master():
        rounds = [[measured(command, rate, count) for command in relays] for _ in range(ROUNDS)]
    ratios = {}
    for k, part in enumerate(PARTS):
        ratios[part] = median(ours[k] / bare[k] for bare, ours in rounds)
        mine = f"{median(ours[k] for _, ours in rounds):.0f} us ({ratios[part]:.2f})"
        figure(f"{rate} Hz{shows}, {part}", mine, f"< {most[part]}" if part in most else "")
    assert not {part for part, limit in most.items() if ratios[part] >= limit}


def measured(command, rate, count):
    """Return the values of PARTS [us]."""
    with running(command, **QUIET) as relay:
        took_s, used_s = delays_and_processor("joy", rate, count, relay.pid)
    return [1e6 * took_s[len(took_s) // 2], 1e6 * took_s[len(took_s) * 99 // 100], 1e6 * used_s]
