"""The driver of a Kobuki and a robot on a serial line: rate, jitter, processor time."""

import live
import numpy as np
import pytest
from live import PERIOD_NS, observe

from tutorial_testing.claims import claim

TOPICS = [
    "/mobile_base/odom", "/tf", "/mobile_base/joint_states", "/mobile_base/sensors/core",
]  # fmt: skip
MOST_LOAD = 0.06


@pytest.fixture(scope="module", autouse=True)
def ros_master():
    with live.master():
        yield


@claim("A Kobuki's odometry comes evenly, at a few percent of a processor")
def test_a_minute_of_odometry(figure, tmp_path):
    port = tmp_path / "kobuki"
    robot = ["rosrun", "fake_turtlebot_sim", "serial_kobuki", f"_link:={port}"]
    driver = ["rosrun", "kobuki_node", "kobuki_node", "__name:=mobile_base"]
    heard, (robots, load) = observe([robot, [*driver, f"_device_port:={port}"]], TOPICS, 60)
    stamps = np.array(heard[TOPICS[0]]["stamps"])
    gaps_ns = np.diff(stamps)
    rate = 1e9 * len(gaps_ns) / (stamps[-1] - stamps[0])
    jitter_ms = np.quantile(np.abs(gaps_ns - PERIOD_NS), 0.99) * 1e-6
    figure("rate over a minute", f"{rate:.3f} Hz", "50 ± 0.1 Hz")
    figure("jitter, 99 of 100 messages", f"{jitter_ms:.2f} ms", "≤ 3 ms")
    figure("processor time of the driver", f"{load:.1%} of a core", f"≤ {MOST_LOAD:.0%}")
    figure("processor time of serial_kobuki", f"{robots:.1%} of a core", "")
    assert abs(rate - 50) <= 0.1
    assert jitter_ms <= 3
    assert load <= MOST_LOAD
