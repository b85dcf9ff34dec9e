"""Maps as map_server reads them: values of cells, the message, the place where a robot starts."""

from math import pi

import numpy as np
import pytest
from PIL import Image

from fake_turtlebot_sim.simulator.grid_map import read_map
from fake_turtlebot_sim.simulator.parameters import parse_parameters
from fake_turtlebot_sim.simulator.world_files import read_world
from fake_turtlebot_sim.simulator.world_messages import world_map

ABOUT = {
    "image": "map.png", "resolution": 0.05, "origin": [0.0, 0.0, 0.0], "negate": 0,
    "occupied_thresh": 0.65, "free_thresh": 0.196,
}  # fmt: skip
PNM = {"image": "map.pgm"}
GREY = np.array([[0, 128, 254]], np.uint8)
COLOURS = Image.fromarray(np.array([[[170, 170, 0], [0, 128, 255]]], np.uint8))
CLEAR = Image.fromarray(
    np.array([[[0, 0, 0, 0], [255, 255, 255, 0], [128, 128, 128, 255]]], np.uint8)
)
PICTURE = Image.fromarray(GREY)
INDEXED = Image.new("P", (2, 1))
INDEXED.putpalette([200, 255, 255, 0, 0, 0])
INDEXED.putdata((0, 1))


@pytest.mark.parametrize(
    ("image", "given", "values"),
    [
        (PICTURE, {}, [100, -1, 0]),
        (PICTURE, {"negate": 1}, [0, -1, 100]),
        (PICTURE, {"mode": "scale"}, [100, 66, 0]),
        (Image.fromarray(GREY.astype(np.uint16) << 8 | 255), {}, [100, -1, 0]),
        (COLOURS, {"mode": "scale"}, [-1, 66]),
        (CLEAR, {"mode": "scale"}, [100, 0, 66]),
        (INDEXED, {}, [100, 100]),  # the number of the colour, as SDL gives it
        (b"P5 4 1 255\n" + bytes([0, 100, 255, 200]), {"mode": "raw", **PNM}, [0, 100, -1, -56]),
        (b"P2 3 1 255\n0 50 # a comment\n100", {"mode": "raw", **PNM}, [0, 50, 100]),
        (b"P2 1 2 255 0 254", PNM, [0, 100]),  # the lowest row first
        (b"P6 1 1 255\n\0\xff\0", PNM, [100]),
    ],
)  # fmt: skip
def test_cells_are_those_of_map_server(tmp_path, image, given, values):
    about = {**ABOUT, **given}
    if isinstance(image, bytes):
        (tmp_path / about["image"]).write_bytes(image)
    else:
        image.save(tmp_path / about["image"])
    assert read_map(tmp_path / "map.yaml", about).cells.ravel().tolist() == values


def write_map(folder, shades, **given):
    """Write a map with its lowest row last, as in an image; return the path."""
    rows, columns = shades.shape
    (folder / "map.pgm").write_bytes(b"P5 %d %d 255\n" % (columns, rows) + shades.tobytes())
    about = {**ABOUT, **PNM, **given}
    (folder / "map.yaml").write_text("".join(f"{name}: {about[name]}\n" for name in about))
    return folder / "map.yaml"


def test_the_message_is_the_map_cell_by_cell(tmp_path):
    shades = np.full((3, 4), 254, np.uint8)
    shades[2, 1], shades[0, 3] = 0, 128
    world = read_world(write_map(tmp_path, shades, origin=[1.0, 2.0, pi / 2]))
    grid = world_map(world, "map", None)
    assert list(grid.data) == [0, 100, 0, 0] + [0] * 7 + [-1]
    info, turn = grid.info, grid.info.origin.orientation
    assert (info.width, info.height, info.resolution) == (4, 3, 0.05)
    assert (info.origin.position.x, info.origin.position.y) == (1.0, 2.0)
    assert (turn.z, turn.w) == pytest.approx((0.5**0.5, 0.5**0.5))
    # Turned by a quarter, the occupied cell is above the origin and left of it.
    assert sorted({round(x, 9) for x, *_ in world.segments}) == [0.95, 1.0]
    assert sorted({round(wall[1], 9) for wall in world.segments}) == [2.05, 2.1]


def start_of(path, **given):
    return parse_parameters({"world": str(path), **given}).start_poses()[""]


def building():
    """Return shades of a sheet that is unknown, with a room of 20 x 20 cells and its wall."""
    shades = np.full((60, 60), 205, np.uint8)
    shades[20:42, 20:42], shades[21:41, 21:41] = 0, 254
    return shades[::-1]


@pytest.mark.parametrize(
    ("given", "place"),
    [
        ({"origin": [-1.5, -1.5, 0]}, (0, 0)),
        ({"origin": [-2.07, -1.525, 0]}, (-0.245, 0)),  # (0, 0) is in the wall
        ({"origin": [0, 0, 0]}, (1.275, 1.275)),  # or beyond it, where nothing is known
        ({"origin": [0, 0, 1.5707963267948966]}, (-1.275, 1.275)),
    ],
)
def test_a_robot_starts_where_it_has_room(tmp_path, given, place):
    assert start_of(write_map(tmp_path, building(), **given)) == pytest.approx((*place, 0.0))


def test_a_start_that_is_given_counts_also_at_zero(tmp_path):
    path = write_map(tmp_path, building(), origin=[-0.5, -0.5, 0])  # nothing is known there
    assert start_of(path, initial_x=0.0) == (0.0, 0.0, 0.0)
    start = "{x: 1.0, y: 0.9, yaw: 0.5}"
    path = write_map(tmp_path, building(), origin=[-0.5, -0.5, 0], start=start)
    assert start_of(path, initial_x="") == (1.0, 0.9, 0.5)
    wall = np.zeros((80, 80), np.uint8)  # 4 m thick
    with pytest.raises(ValueError, match=r"\(0, 0\) would be inside of a wall"):
        start_of(write_map(tmp_path, wall, origin=[-2, -2, 0]), initial_x=0.0)
    with pytest.raises(ValueError, match="no free place where a robot has room; give another"):
        start_of(write_map(tmp_path, wall, origin=[-2, -2, 0]))
