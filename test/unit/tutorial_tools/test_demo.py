"""What the demonstration refuses before it starts; test/system/ has some as a user sees them."""

from pathlib import Path

import pytest

from tutorial_tools.demo.launch import DemoError
from tutorial_tools.demo.program import check_bag
from tutorial_tools.launch_arguments import launch_arguments

JOY2TWIST = Path(__file__).resolve().parents[3] / "joy2twist"
LAUNCH_FILE = str(JOY2TWIST / "launch" / "launch_bag.launch")


@pytest.mark.parametrize("size", [0, 12, 30, 4096, 5000, 20_000, -4000, -1])
def test_a_truncated_bag_gets_one_clear_line(tmp_path, capfd, size):
    bag = tmp_path / "truncated.bag"
    bag.write_bytes((JOY2TWIST / "bag" / "joy.bag").read_bytes()[:size])
    with pytest.raises(DemoError) as said:
        check_bag(bag)
    assert str(said.value).startswith(f"{bag}: ")
    assert len(str(said.value).splitlines()) == 1
    assert capfd.readouterr() == ("", "")


def test_a_folder_is_no_bag():
    with pytest.raises(DemoError, match=r"^/: cannot be read: Is a directory$"):
        check_bag("/")


@pytest.mark.parametrize(
    ("argument", "line"),
    [
        ("rviz", "rviz: not NAME:=VALUE, := is missing$"),
        ("rviz=true", "rviz=true: not NAME:=VALUE, := is missing; did you mean rviz:=true.$"),
        ("virtual=true", "virtual=true: not an argument of launch_bag.launch, which has bag:="),
        ("rvz:=1", "rvz:=1: not an argument of launch_bag.launch, .*; did you mean rviz:=.$"),
        ("colour:=red", "colour:=red: not an argument of launch_bag.launch, which has bag:="),
        ("rviz:=perhaps", "rviz:=perhaps: must be true or false"),
    ],
)
def test_a_wrong_argument_is_named(argument, line):
    with pytest.raises(ValueError, match=f"^{line}"):
        launch_arguments(LAUNCH_FILE, [argument])
