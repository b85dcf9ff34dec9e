"""Maps, read like map_server does: values of cells, the message, a robot's starting place."""

import struct
import sys
from io import BytesIO
from math import pi
from zlib import crc32

import numpy as np
import pytest
from PIL import Image

from fake_turtlebot_sim.simulator.grid_map import read_map
from fake_turtlebot_sim.simulator.parameters import parse_parameters
from fake_turtlebot_sim.simulator.world_files import read_world
from fake_turtlebot_sim.simulator.world_messages import world_map
from tutorial_testing.claims import claim

pytestmark = claim("Maps are read as map_server reads them")
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
ONE_BIT = Image.new("1", (4, 2))
ONE_BIT.putdata((0, 1, 1, 1, 0, 1, 1, 1))
HOLED = Image.fromarray(np.array([[0, 205, 254, 100]], np.uint8))  # gray, with alpha
BMP, PBM = {"image": "map.bmp"}, {"image": "map.pbm"}
SCALED, RAW = {"mode": "scale"}, {"mode": "raw"}


def bmp(bits, pixels, columns, compression=0, masks=b""):
    """Return a BMP of one row."""
    length = -(-columns * bits // 32) * 4
    colours = b"".join(bytes((k, k, k, 0)) for k in range(2**bits)) if bits <= 8 else b""
    head = struct.pack("<IiiHHIIiiII", 40, columns, 1, 1, bits, compression, 0, 0, 0, 0, 0)
    start = 14 + len(head + masks + colours)
    file = b"BM" + struct.pack("<IHHI", start + length, 0, 0, start)
    return file + head + masks + colours + pixels.ljust(length, b"\0")


BLUE_CYAN_WHITE = bytes((255, 0, 0, 255, 128, 0, 254, 254, 254))  # B, G, R
CLEAR_SOLID = bytes((100, 100, 100, 0, 100, 100, 100, 255))  # B, G, R, A


@pytest.mark.parametrize(("image", "given", "values"), [
    (PICTURE, {}, [100, -1, 0]),
    (PICTURE, {"negate": 1}, [0, -1, 100]),
    (PICTURE, {"mode": "scale"}, [100, 66, 0]),
    (Image.fromarray(GREY.astype(np.uint16) << 8 | 255), {}, [100, -1, 0]),
    (COLOURS, {"mode": "scale"}, [-1, 66]),
    (CLEAR, {"mode": "scale"}, [100, 0, 66]),
    (INDEXED, {}, [100, 100]),  # the index of the colour, as SDL gives it
    (b"P5 4 1 255\n" + bytes([0, 100, 255, 200]), {"mode": "raw", **PNM}, [0, 100, -1, -56]),
    (b"P2 3 1 255\n0 50 # a comment\n100\n", {"mode": "raw", **PNM}, [0, 50, 100]),
    (b"P2 1 2 255 0 254 ", PNM, [0, 100]),  # the lowest row comes first
    (b"P6 1 1 255\n\0\xff\0", PNM, [100]),
    # Measured from here on: map_server's rules with the pixels of SDL_image 1.2.12.
    (ONE_BIT, BMP, [100] * 8),  # the index of the colour, 0 or 1
    (ONE_BIT, PBM, [100] * 8),
    (b"P1 4 1\n0110\n", {**PBM, "negate": 1}, [0] * 4),
    (b"P1 4 1\n0 1 1 0\n", {**PBM, **RAW}, [0, 1, 1, 0]),
    (bmp(4, b"\x0f\xf0", 4), {**BMP, **RAW}, [0, 15, 15, 0]),
    (bmp(8, bytes((0, 205, 254)), 3), BMP, [100, -1, 0]),
    (bmp(16, b"\x64\xff", 1), {**BMP, **SCALED}, [24]),
    (bmp(24, BLUE_CYAN_WHITE, 3), {**BMP, **SCALED}, [100, -1, 0]),  # R counts as alpha
    (bmp(24, BLUE_CYAN_WHITE, 3), BMP, [100, -1, 0]),
    (bmp(32, CLEAR_SOLID, 2), BMP, [100, -1]),  # alpha is averaged, too
    (bmp(32, CLEAR_SOLID, 2), {**BMP, **SCALED}, [-1, 89]),
    (bmp(32, CLEAR_SOLID, 2), {**BMP, **RAW}, [100, 100]),
    (bmp(32, CLEAR_SOLID, 2, 3, struct.pack("<IIII", 255 << 16, 255 << 8, 255, 0)),
     {**BMP, **RAW}, [75, -118]),
    (b"P5 4 1 127\n\0\x28\x7f\x40", {**PNM, **RAW}, [0, 80, -1, -128]),
    (b"P2 3 1 100\n0 50 100\n", {**PNM, **RAW}, [0, 127, -1]),  # truncated, so not -128
    (b"P5 3 1 15\n\0\x07\x0f", {**PNM, **SCALED}, [100, 73, 0]),
])  # fmt: skip
def test_cells_are_those_of_map_server(tmp_path, image, given, values):
    about = {**ABOUT, **given}
    if isinstance(image, bytes):
        (tmp_path / about["image"]).write_bytes(image)
    else:
        image.save(tmp_path / about["image"])
    assert read_map(tmp_path / "map.yaml", about).cells.ravel().tolist() == values


@pytest.mark.parametrize(("image", "transparency", "values"), [
    (HOLED, 205, [-1, -1, 0, -1]),  # gray and alpha, averaged
    (HOLED.point(lambda shade: shade // 16 * 17), 204, [-1, -1, 0, -1]),
    (COLOURS, (170, 170, 0), [-1, -1]),  # no effect in RGB
    (INDEXED, b"\xff\0", [100, 100]),
    (INDEXED, b"\xff\xff", [100, 100]),
    (INDEXED, b"\xff\x80", [0, 100]),  # half of a colour: RGBA
])  # fmt: skip
def test_transparency_of_a_png_counts_as_in_sdl_image(tmp_path, image, transparency, values):
    image.save(tmp_path / "map.png", transparency=transparency)
    assert read_map(tmp_path / "map.yaml", ABOUT).cells.ravel().tolist() == values


def test_of_16_bits_all_count_for_transparency(tmp_path):
    picture, data = Image.fromarray(np.array([[0, 205 << 8 | 7, 205 << 8]], np.uint16)), BytesIO()
    picture.save(data, "PNG")
    png, chunk = data.getvalue(), b"tRNS" + struct.pack(">H", 205 << 8)
    head, pixels = png[:33], png[33:]  # after IHDR
    chunk = struct.pack(">I", 2) + chunk + struct.pack(">I", crc32(chunk))
    (tmp_path / "map.png").write_bytes(head + chunk + pixels)
    assert read_map(tmp_path / "map.yaml", ABOUT).cells.ravel().tolist() == [-1, 0, -1]


@pytest.mark.parametrize(
    "data", [b"P2 2 1 255\n0 254\n", b"P5 2 1 255\n\0\xfe", bmp(24, bytes(3) + b"\xfe" * 3, 2)]
)
def test_all_but_png_are_read_without_pillow(tmp_path, monkeypatch, data):
    monkeypatch.setitem(sys.modules, "PIL", None)
    (tmp_path / "map.png").write_bytes(data)
    assert read_map(tmp_path / "map.yaml", ABOUT).cells.ravel().tolist() == [100, 0]


def write_map(folder, shades, **given):
    """Write a map, its lowest row last as in an image; return the path."""
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
    # After a quarter turn the occupied cell is above and left of the origin.
    assert sorted({round(x, 9) for x, *_ in world.segments}) == [0.95, 1.0]
    assert sorted({round(wall[1], 9) for wall in world.segments}) == [2.05, 2.1]


def start_of(path, **given):
    return parse_parameters({"world": str(path), **given}).start_poses()[""]


def building():
    """Return the shades of an unknown area with a walled room of 20 x 20 cells."""
    shades = np.full((60, 60), 205, np.uint8)
    shades[20:42, 20:42], shades[21:41, 21:41] = 0, 254
    return shades[::-1]


@pytest.mark.parametrize(("given", "place"), [
    ({"origin": [-1.5, -1.5, 0]}, (0, 0)),
    ({"origin": [-2.07, -1.525, 0]}, (-0.245, 0)),  # (0, 0) is in the wall
    ({"origin": [0, 0, 0]}, (1.275, 1.275)),  # (0, 0) is beyond it, in the unknown area
    ({"origin": [0, 0, 1.5707963267948966]}, (-1.275, 1.275)),
])  # fmt: skip
def test_a_robot_starts_where_it_has_room(tmp_path, given, place):
    assert start_of(write_map(tmp_path, building(), **given)) == pytest.approx((*place, 0.0))


def test_a_start_that_is_given_counts_also_at_zero(tmp_path):
    path = write_map(tmp_path, building(), origin=[-0.5, -0.5, 0])  # (0, 0) is in the unknown area
    assert start_of(path, initial_x=0.0) == (0.0, 0.0, 0.0)
    start = "{x: 1.0, y: 0.9, yaw: 0.5}"
    path = write_map(tmp_path, building(), origin=[-0.5, -0.5, 0], start=start)
    assert start_of(path, initial_x="") == (1.0, 0.9, 0.5)
    wall = np.zeros((80, 80), np.uint8)  # 4 m thick
    with pytest.raises(ValueError, match=r"\(0, 0\) would be inside a wall"):
        start_of(write_map(tmp_path, wall, origin=[-2, -2, 0]), initial_x=0.0)
    with pytest.raises(ValueError, match="no free place where a robot has room; give another"):
        start_of(write_map(tmp_path, wall, origin=[-2, -2, 0]))
