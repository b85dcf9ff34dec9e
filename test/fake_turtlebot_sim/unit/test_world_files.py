"""Worlds from files: our format, map_server's, and invalid ones."""

import os
import sys
from io import BytesIO

import numpy as np
import PIL
import pytest
from PIL import Image

from fake_turtlebot_sim.errors import WorldError
from fake_turtlebot_sim.simulator.parameters import parse_parameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from fake_turtlebot_sim.simulator.world_files import read_world
from fake_turtlebot_sim.simulator.world_messages import world_map, world_markers
from tutorial_testing.claims import claim
from tutorial_testing.hostile import end_of

pytestmark = claim("World files have bounds; a mistake or a hostile file is one line")
OURS = """\
walls:
  - [[0, 0], [4, 0], [4, 3]]
posts:
  - {x: 1, y: 1, radius: 0.2}
cliffs: [[[2, 2], [3, 2], [3, 3]]]
start: {x: 0.5, y: 0.5, yaw: 1.57}
"""
MAP = """\
image: map.pgm
resolution: 0.5
origin: [-1, 2, 0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""


def world_of(tmp_path, text):
    (tmp_path / "world.yaml").write_text(text)
    return read_world(tmp_path / "world.yaml")


def test_a_world_of_ours(tmp_path):
    world = world_of(tmp_path, OURS)
    assert world.segments == ((0, 0, 4, 0, 0), (4, 0, 4, 3, 0))
    assert world.posts == ((1, 1, 0.2),)
    assert world.start == (0.5, 0.5, 1.57)
    assert world.is_cliff(2.9, 2.5) and not world.is_cliff(2.1, 2.9) and not world.is_cliff(1, 1)


@pytest.mark.parametrize(("text", "said"), [
    ("walls: [[[0, 0]]]", "line 1: walls: must be a list of polylines"),
    ("posts:\n- {x: 1, y: 1, radius: 1}\n- {x: 1, y: 1, radius: -1}", "line 3: posts: must be"),
    ("start: {x: 1, y: 2, yaw: 90}", "line 1: start: must be"),
    ("posts: []\ncolour: red", "line 2: colour: is unknown"),
    ("walls: [", ": not YAML"),
    ("walls: {}\nwalls: []", "line 1: walls: is listed twice"),
    ("- 1", "must be a map of walls, posts"),
    ("walls: &a [*a]", "line 1: *NAME, or more than 20 lists"),
    ("walls: [[[0, 0], [10001, 0]]]", "up to 10000 m"),
    (f"posts: {[{'x': 1, 'y': 1, 'radius': 1}] * 2001}", "2001 are too many: at most 2000"),
    (f"{MAP}mode: binary", "mode: must be trinary, scale, raw or left out"),
    (f"{MAP}resolution: 0", "resolution: 0: must be a number from 0.001 to 100"),
    (MAP.replace("resolution", "resolutoin"), "resolution: is missing; a map needs it"),
    (f"{MAP}image: /dev/zero", "/dev/zero: cannot be read as an image: not a plain file"),
])  # fmt: skip
def test_a_mistake_is_one_line(tmp_path, text, said):
    with pytest.raises(WorldError) as error:
        world_of(tmp_path, text)
    assert said in str(error.value) and "\n" not in str(error.value)


def png(shade):
    """Return a PNG of one pixel."""
    data = BytesIO()
    Image.fromarray(np.full((1, 1), shade)).save(data, "PNG")
    return data.getvalue()


@pytest.mark.parametrize(("data", "said"), [
    (b"GIF89a", "no PGM, PNG or BMP"),
    (b"P2 3 1 255\n0 50 -1\n", "its shades must be numbers from 0 to 255"),
    (b"P2 3 1 255\n", "its shades must be numbers"),
    (b"P2 3 1 255\n0 50\n", "cut short"),
    (b"P2 3 1 255\n0 50 100", "needs an end of line after the last number"),
    (b"P1 3 1\n01\n", "cut short"),
    (b"P5 3 1 255\n\0\0", "cut short"),
    (b"P5 3 1\n", "its header is malformed"),
    (b"P5 2 1 256\n" + bytes(4), "256 shades: .* does not load on the robot .*; convert it"),
    (b"P5 2 1 65535\n" + bytes(4), "65535 shades: .*convert OLD.pgm -depth 8 NEW.pgm"),
    (png(np.uint16(255)), "map_server reads the higher 8 of its 16 bits"),
    (png(np.uint8(0))[:30], "cut short"),
    (b"BM" + bytes(40), "none"),
    (b"P5 20 10 255\n" + bytes(200), "extends farther than 10000 m"),
    (b"P5 4096 4097 255\n", "more than 16777216 cells"),
    (png(np.uint8(0)), "needs Pillow: apt install python3-pil"),  # where Pillow is missing
])  # fmt: skip
def test_an_image_that_is_no_map_is_one_line(tmp_path, monkeypatch, data, said):
    monkeypatch.setitem(sys.modules, "PIL", None if "Pillow" in said else PIL)
    (tmp_path / "map.pgm").write_bytes(data)
    resolution = 100 if "farther" in said else 0.5
    with pytest.raises(WorldError, match=said):
        world_of(tmp_path, f"{MAP}resolution: {resolution}\norigin: [9000, 0, 0]")


def test_what_never_ends_is_not_read(tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    (tmp_path / "zero.yaml").symlink_to("/dev/zero")
    (tmp_path / "large.yaml").write_text(" " * 2_000_001)
    for name in ("pipe.yaml", "zero.yaml", "large.yaml", "."):
        with pytest.raises(WorldError, match="cannot be read: not a plain file"):
            read_world(tmp_path / name)


def live_in(path):
    """Read a world and drive in it like the node; return the exit code."""
    try:
        parameters = parse_parameters({"world": str(path)})
        robot = SimulatedRobot(parameters, parameters.start_poses()[""])
    except ValueError as error:
        print(error, file=sys.stderr)
        return 1
    world_map(parameters.world, "map", None)
    world_markers(parameters.world, "map")
    for cycle in range(50):
        robot.command((0.7, cycle % 3 - 1.0), cycle * 20_000_000)
        robot.advance((cycle + 1) * 20_000_000)
        robot.sensed()
    return 0


IMAGE = b"P5 300 300 255\n" + bytes([0, 254] * 150 + [254, 0] * 150) * 150
HOSTILE = [
    ("walls: " + str([[[k / 200, k % 7], [k / 200 + 1, k % 5]] for k in range(1, 20_000)]), IMAGE),
    ("- &a0 [1]\n" + "".join(f"- &a{k} [{f'*a{k - 1},' * 9}]\n" for k in range(1, 2000)), IMAGE),
    ("cliffs: " + str([[[k % 9, k / 40], [9, 0], [9, 9]] for k in range(40, 370)]), IMAGE),
    *((one, IMAGE) for one in ("[" * 60_000, "? " * 30_000, "walls: 1" + ":59" * 20_000, "")),
    *((one, IMAGE) for one in ("<<: {walls: []}", "start: 2001-99-99", "walls: !!timestamp x")),
    *((MAP, one) for one in (IMAGE, b"P6 9999999 9999999 255\n" + bytes(99))),
]


@pytest.mark.parametrize(("text", "image"), HOSTILE, ids=range(len(HOSTILE)))
def test_a_hostile_world_is_a_world_or_one_line(tmp_path, text, image):
    (tmp_path / "map.pgm").write_bytes(image)
    (tmp_path / "world.yaml").write_text(text)
    end_of(lambda: live_in(tmp_path / "world.yaml"))
