"""rqt_bag of this suite: its picture of a joystick, and its line about a file that is no bag."""

from xml.etree import ElementTree

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY
from tutorial_tools.joystick_chart import curves, svg
from tutorial_tools.ros.rqt_bag import main

pytestmark = claim("rqt_bag draws what moves, and a damaged bag is one line")
WHOLE = (REPOSITORY / "common/gamepad/bag/joy.bag").read_bytes()
RECORDED = [  # time [s], axes, buttons
    (10.0, (0.0, 0.0, 1.0), (0, 0)),
    (11.0, (0.0, 0.5, 1.0), (0, 1)),
    (12.0, (0.0, -1.0, 1.0), (0, 0)),
]


def test_only_what_moves_is_drawn_or_else_all_axes():
    assert curves(RECORDED) == [
        ("axes[1]", [(0.0, 0.0), (1.0, 0.5), (2.0, -1.0)]),
        ("buttons[1]", [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]),
    ]
    assert [name for name, _ in curves(RECORDED[:1] * 2)] == ["axes[0]", "axes[1]", "axes[2]"]
    root = ElementTree.fromstring(svg("a < b.bag", curves(RECORDED)))
    assert len(root.findall("{http://www.w3.org/2000/svg}polyline")) == 2


@pytest.mark.parametrize(("data", "words"), [
    (None, 'no such file. For ours: cp "$(rospack find gamepad)/bag/joy.bag" .'),
    (b"no bag", "not a bag that can be read"),
    (WHOLE[:20_000], "cut short; fix it with: rosbag reindex"),
], ids=["missing", "no bag", "cut"])  # fmt: skip
def test_a_file_that_is_no_whole_bag_is_one_line(tmp_path, monkeypatch, capfd, data, words):
    path = tmp_path / "joy.bag"
    if data is not None:
        path.write_bytes(data)
    monkeypatch.setattr("sys.argv", ["rqt_bag", str(path)])
    with pytest.raises(SystemExit) as end:
        main()
    (line,) = str(end.value).splitlines()
    assert line.startswith(f"rqt_bag: {path}: ") and words in line
    assert capfd.readouterr() == ("", "")
