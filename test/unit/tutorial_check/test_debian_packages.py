"""The Debian packages of modules and ROS packages, and what Debian lacks."""

import pytest

from tutorial_check.debian_packages import in_place_of, package_of_module, packages_of_ros


@pytest.mark.parametrize(
    ("name", "module", "package"),
    [
        ("tf", "python3-tf", "libtf-dev tf-tools"),
        ("tf2_ros.buffer", "python3-tf2-ros", ""),
        ("PyKDL", "python3-pykdl", "python3-pykdl"),
        ("cv_bridge", "python3-cv-bridge", "libcv-bridge-dev"),
        ("Tkinter", "python3-tk", "python3-tk"),
        ("image_view", "", "libimage-view-dev ros-image-view"),
        ("xacro", "", ""),
        ("sensor_msg", "", ""),
    ],
)
def test_the_package_of_a_name(name, module, package):
    assert package_of_module(name) == module
    assert packages_of_ros(name) == (package or module)


def test_what_debian_lacks():
    assert "has its model" in in_place_of("xacro")
    assert "another robot" in in_place_of("turtlebot3_teleop")
    assert in_place_of("tf") == ""
