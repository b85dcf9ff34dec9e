"""What turtles draw, pixel by pixel."""

import math

import pytest

from simulated_turtles.paper import Paper
from simulated_turtles.turtle import FIELD_M

BLUE, RED = (69, 86, 255), (255, 0, 0)
M = 1 / 45  # a pixel


@pytest.fixture
def paper():
    blank = Paper()
    blank.fill(BLUE)
    blank.take_changes()
    return blank


@pytest.mark.parametrize(("width", "reach"), [(1, 0), (3, 1), (9, 4)])
def test_a_line_is_as_wide_as_its_pen(paper, width, reach):
    paper.line((1.0, 2.0), (3.0, 2.0), RED, width)
    rows = [k for k in range(-9, 10) if paper.color_at(2.0, 2.0 + k * M) == RED]
    assert rows == list(range(-reach, reach + 1))
    assert paper.color_at(0.7, 2.0) == paper.color_at(3.3, 2.0) == BLUE


def test_where_a_thin_line_ends_is_its_color_in_every_direction(paper):
    for k in range(24):
        end = 5.0 + math.cos(k), 5.0 + math.sin(k)
        paper.line((5.0, 5.0), end, (k, 0, 0), 1)
        assert paper.color_at(*end) == (k, 0, 0)


def test_only_what_changed_is_handed_out_as_an_image(paper):
    assert paper.take_changes() is None
    paper.line((1.0, FIELD_M - 1.0), (1.2, FIELD_M - 1.0), RED, 3)
    column, row, image = paper.take_changes()
    assert (column, row) == (43, 43)
    assert image.startswith(b"P6 14 5 255\n") and len(image) == 12 + 14 * 5 * 3
    assert image.count(bytes(RED)) == 36  # 3 rows of 10, and 3 at each end
    assert paper.take_changes() is None
    paper.fill(BLUE)
    assert paper.take_changes()[:2] == (0, 0)


def test_lines_from_and_to_far_away_are_cut_at_the_edge(paper):
    paper.line((5.0, 5.0), (1e38, 5.0), RED, 3)
    paper.line((-9.0, -9.0), (-8.0, -8.0), RED, 255)
    assert paper.color_at(FIELD_M, 5.0) == RED and paper.color_at(0.0, 0.0) == BLUE
