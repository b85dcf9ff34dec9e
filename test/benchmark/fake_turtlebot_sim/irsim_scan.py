"""Times the laser of IR-SIM among walls, for test_world_speed.py; run by a Python that has ir-sim.

    irsim_scan.py WALLS.json BEAMS RANGE [m] SCANS

WALLS: [[x1, y1, x2, y2], ...] [m]. Prints the time of a scan [s].
"""

import json
import sys
import tempfile
import time
from pathlib import Path

import irsim
import yaml

walls, (beams, reach, scans) = json.loads(Path(sys.argv[1]).read_text()), map(float, sys.argv[2:])
lidar = {"name": "lidar2d", "number": int(beams), "range_max": reach, "angle_range": 6.28}
world = {
    "world": {"width": 40, "height": 40},
    "robot": {"kinematics": {"name": "diff"}, "state": [20, 20, 0], "sensors": [lidar]},
    "obstacle": [
        {"shape": {"name": "linestring", "vertices": [[x1, y1], [x2, y2]]}, "state": [0, 0, 0]}
        for x1, y1, x2, y2 in walls
    ],
}
with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
    yaml.safe_dump(world, file)
    file.flush()
    env = irsim.make(file.name, display=False, log_level="ERROR")
laser = env.robot.sensors[0]
times = []
for _ in range(int(scans)):
    began = time.perf_counter()
    laser.step(env.robot.state)
    times.append(time.perf_counter() - began)
assert min(laser.range_data) < reach, "it sees nothing"
print(sorted(times)[len(times) // 2])
