"""rqt_bag of this suite: what it says of a file that it cannot read."""

import pytest

from tutorial_tools.bag.program import read


def refused(path):
    with pytest.raises(SystemExit) as end:
        read(path)
    assert "\n" not in str(end.value)
    return str(end.value)


def test_a_bag_that_is_not_there(tmp_path):
    said = refused(tmp_path / "joy.bag")
    assert "no such file" in said
    assert 'cp "$(rospack find gamepad)/bag/joy.bag" .' in said


def test_a_folder(tmp_path):
    assert "cannot be read: Is a directory" in refused(tmp_path)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "not a bag that can be read"),
        (b"no bag", "not a bag that can be read"),
        (b"#ROSBAG V2.0\n", "cut short; mend it with: rosbag reindex"),
    ],
)
def test_what_is_no_whole_bag(tmp_path, data, words):
    path = tmp_path / "joy.bag"
    path.write_bytes(data)
    assert words in refused(path)
