"""From a header that the compiler does not find to what to write."""

import pytest

from tutorial_check.checking import header_errors
from tutorial_check.checking.build_errors import build_error
from tutorial_testing.claims import claim
from tutorial_testing.submissions import MANIFEST

CMAKE = (
    "find_package(catkin REQUIRED COMPONENTS roscpp)\n"
    "include_directories(${catkin_INCLUDE_DIRS})\nadd_executable(talker src/talker.cpp)\n"
)
FILES = {
    "mine/CMakeLists.txt": CMAKE,
    "mine/src/talker.cpp": "",
    "mine/src/wheel.h": "",
    "mine/include/mine/robot.h": "",
    "other/package.xml": MANIFEST.format("other"),
    "other/CMakeLists.txt": "add_message_files(FILES Num.msg)\ngenerate_messages()\n",
    "other/msg/Num.msg": "int64 num\n",
    "other/include/other/filter.hpp": "",
}
INSTALLED = ("ros/ros.h", "std_msgs/String.h", "geometry_msgs/Pose.h", "kobuki_msgs/Sound.h")
FAILED = (
    "make[2]: *** [mine/CMakeFiles/talker.dir/build.make:76: "
    "mine/CMakeFiles/talker.dir/src/talker.cpp.o] Error 1\n"
)


@pytest.fixture
def hint_of(make_submission, tmp_path, monkeypatch):
    """hint_of(header): the hint of a program that includes it."""

    def hint(header, cmake=CMAKE):
        session = make_submission("mine", "2")
        for path, text in {**FILES, "mine/CMakeLists.txt": cmake}.items():
            (session.source / path).parent.mkdir(parents=True, exist_ok=True)
            (session.source / path).write_text(text)
        session.underlay_environment = {"CMAKE_PREFIX_PATH": str(tmp_path / "ros")}
        monkeypatch.setattr(header_errors, "SYSTEM", tmp_path / "system")
        for name in (*(f"ros/include/{name}" for name in INSTALLED), "system/c++/12/sstream"):
            (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name).write_text("")
        program = session.source / "mine/src/talker.cpp"
        error = f"{program}:2:10: fatal error: {header}: No such file or directory\n"
        wrong = build_error(session, error + FAILED)
        assert wrong.where == "mine/src/talker.cpp:2"
        return wrong.hint

    return hint


@claim("A misspelt header is compared with those that are installed, and with the student's own")
@pytest.mark.parametrize(("header", "words"), [
    ("ros.h", "is #include <ros/ros.h> meant?"),
    ("Ros/ros.h", "is #include <ros/ros.h> meant?"),
    ("ros/Ros.h", "is #include <ros/ros.h> meant?"),
    ("ros/ros", "is #include <ros/ros.h> meant?"),
    ("roscpp/ros.h", "is #include <ros/ros.h> meant?"),
    ("std_msgs/string.h", "is #include <std_msgs/String.h> meant?"),
    ("std_msgs/Strings.h", "is #include <std_msgs/String.h> meant?"),
    ("std_msg/String.h", "is #include <std_msgs/String.h> meant?"),
    ("String.h", "is #include <std_msgs/String.h> meant?"),
    ("sstreem", "is #include <sstream> meant?"),
    ("robott.h", 'is #include "mine/robot.h" meant?'),
    ("wheels.h", 'is #include "wheel.h" meant?'),
    ("ros\\ros.h", "a path is written with /"),
    (" std_msgs/String.h", "no blank belongs between < and >"),
    ("std_msgs.h", "each message has a header of its own: <std_msgs/NAME.h>"),
    ("rclcpp/rclcpp.hpp", "this is ROS 2"),
    ("std_msgs/msg/string.hpp", "this is ROS 2"),
    ("/home/me/src/mine/include/robot.h", "an absolute path exists on one machine"),
    ("nothing/like/this.h", "look at the spelling; a file of your own has to be handed in"),
])  # fmt: skip
def test_a_misspelt_header_is_compared_with_others(header, words, hint_of):
    assert words in hint_of(header)


@claim("A header that exists, and is not found, has the line that CMakeLists.txt lacks")
@pytest.mark.parametrize(("header", "words"), [
    ("mine/robot.h", "include_directories(include ${catkin_INCLUDE_DIRS})"),
    ("robot.h", "is #include \"mine/robot.h\" meant?"),
    ("wheel.h", "wheel.h is in src: add that folder to include_directories"),
    ("kobuki_msgs/Sound.h", "name kobuki_msgs in find_package(catkin REQUIRED COMPONENTS"),
    ("other/Num.h", "name other in find_package(catkin REQUIRED COMPONENTS"),
    ("other/filter.hpp", "name other in find_package(catkin REQUIRED COMPONENTS"),
    ("control_msgs/Grip.h", "Debian lacks control_msgs"),
    ("stereo_image_proc/disparity.h", "sudo apt install libstereo-image-proc-dev"),
])  # fmt: skip
def test_a_header_that_exists_has_the_line_that_is_lacking(header, words, hint_of):
    assert words in hint_of(header)


def test_a_header_of_ros_is_not_found_without_include_directories(hint_of):
    """With a ROS in /opt/ros; Debian's headers are where the compiler looks anyway."""
    cmake = CMAKE.replace("include_directories(${catkin_INCLUDE_DIRS})\n", "")
    assert hint_of("ros/ros.h", cmake) == (
        "include_directories(${catkin_INCLUDE_DIRS}) belongs above add_executable"
    )
