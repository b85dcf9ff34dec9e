"""Where the windows of rqt are on the cockpit's page."""

import pytest

from tutorial_tools.windows import place


@pytest.mark.parametrize(
    ("line", "shown"),
    [
        ("rqt", ""), ("rqt_console", "log"), ("rqt_plot", "plot"), ("rqt_topic /x", "topics/x"),
        ("rqt_plot turtle1/pose/x:y,/joy/axes[1] /a b", "plot?f=/turtle1/pose/x&f=/turtle1/pose/y"
         "&f=/joy/axes[1]&f=/a&f=/b"),
        ('rqt_plot /a&last=1#"', "plot?f=/a%26last%3D1%23%22"),
    ],
)  # fmt: skip
def test_place_of_a_window(line, shown):
    window, *names = line.split()
    assert place(window, names) == shown
