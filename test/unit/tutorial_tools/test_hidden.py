"""A student's package that hides a stand-in, and needs what is not installed."""

from pathlib import Path

from tutorial_tools.hidden import hidden_stand_ins

SUITE = Path(__file__).resolve().parents[3]


def package(folder, launch=""):
    """Make a package with a launch file as rbx1_bringup has it."""
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>any</name></package>")
    (folder / "launch" / "fake_turtlebot.launch").write_text(f"<launch>{launch}</launch>")


def test_only_what_lacks_a_package_is_reported(tmp_path):
    src, share = tmp_path / "src", tmp_path / "share"
    package(share / "rviz")
    package(src / "clone" / "description")
    package(src / "kobuki_msgs")  # whole
    package(src / "joy2twist", '<node pkg="nowhere"/>')  # no stand-in
    assert hidden_stand_ins(tmp_path, SUITE, share) == []
    package(
        src / "clone" / "rbx1_bringup",
        """<!-- $(find commented_out) --> <param command="$(find xacro)/x $(find description)"/>
        <node pkg="arbotix_python"/><node pkg='rviz'/><node pkg="fake_turtlebot_sim"/>""",
    )
    folder = src / "clone" / "rbx1_bringup"
    assert hidden_stand_ins(tmp_path, SUITE, share) == [
        (
            f"{folder} hides the suite's own rbx1_bringup, and needs arbotix_python, xacro, "
            "which is not installed",
            f"touch {folder}/CATKIN_IGNORE",
        )
    ]
    (folder / "CATKIN_IGNORE").touch()
    assert hidden_stand_ins(tmp_path, SUITE, share) == []
