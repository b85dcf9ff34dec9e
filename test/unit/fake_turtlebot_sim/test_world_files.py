"""Worlds from files: ours, map_server's, and what is no world."""

import pytest
from PIL import Image

from fake_turtlebot_sim.simulator.world import Surroundings
from fake_turtlebot_sim.simulator.world_files import WorldError, read_world

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


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("walls: [[[0, 0]]]", "line 1: walls: must be a list of polylines"),
        ("posts: []\nwalls: 3", "line 2: walls: must be"),
        ("posts:\n- {x: 1, y: 1, radius: 1}\n- {x: 1, y: 1, radius: -1}", "line 3: posts: must be"),
        ("start: {x: 1, y: 2, yaw: 90}", "line 1: start: must be"),
        ("walls:\n- [[0, 0], [1, two]]", "line 2: walls: must be"),
        ("posts:\n- {x: 1, y: 1}", "line 2: posts: must be"),
        ("cliffs: [[[0, 0], [1, .nan], [1, 1]]]", "line 1: cliffs: must be"),
        ("start: {x: 1, y: 2, yaw: 0, z: 3}", "line 1: start: must be"),
        ("posts: []\ncolour: red", "line 2: colour: is not known"),
        ("walls: [", "line 1: not YAML"),
        ("- 1", "must be a map of walls, posts"),
        ("image: none.pgm", "a map needs resolution, origin [x, y, yaw]"),
        (f"{MAP}negate: false", "free_thresh and mode"),
        (f"{MAP}mode: binary", "('trinary', 'scale', 'raw') or none"),
        (f"{MAP}start: {{x: 1, y: 2}}", "start: must be {x: ..., y: ..., yaw: ...}"),
        (MAP, "map.pgm: cannot be read as an image: [Errno 2]"),
    ],
)
def test_a_mistake_is_one_line(tmp_path, text, said):
    with pytest.raises(WorldError) as error:
        world_of(tmp_path, text)
    assert said in str(error.value) and "\n" not in str(error.value)


def test_a_map_has_walls_around_its_occupied_cells(tmp_path):
    picture = Image.new("L", (4, 3), 254)
    for cell in ((1, 1), (2, 1)):  # x from the left, y from the top
        picture.putpixel(cell, 0)
    picture.save(tmp_path / "map.pgm")
    world = world_of(tmp_path, MAP)
    assert {frozenset((wall[:2], wall[2:4])) for wall in world.segments} == {
        frozenset(ends)
        for ends in (
            ((-0.5, 2.5), (0.5, 2.5)), ((-0.5, 3.0), (0.5, 3.0)),
            ((-0.5, 2.5), (-0.5, 3.0)), ((0.5, 2.5), (0.5, 3.0)),
        )
    }  # fmt: skip


def test_what_is_near_is_found_anew_after_a_long_way(tmp_path):
    around = Surroundings(world_of(tmp_path, OURS))
    assert list(around.near(0.0, 0.9, 0.5)) == [(0, 0, 4, 0, 0), (1, 1, 1, 1, 0.2)]
    assert (4, 0, 4, 3, 0) in around.near(3.6, 2.0, 0.5)
    assert len(around.near(3.6, 2.0, 50.0)) == 3
