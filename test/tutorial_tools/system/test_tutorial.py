"""./tutorial as a user calls it: its output, its exit code and what it leaves behind."""

import re
import socket
import subprocess

from tutorial_testing.claims import claim
from tutorial_testing.processes import Program
from tutorial_testing.waiting import LONGEST_S

MANIFEST = """\
<package format="2"><name>{}</name><version>0.0.1</version><description>d</description>
<maintainer email="ada@u.example">Ada</maintainer><license>BSD</license>
<buildtool_depend>catkin</buildtool_depend><depend>{}</depend></package>
"""


@claim("Words, kinds of tests and options complete in bash")
def test_completion_in_bash(tutorial, call):
    script = 'eval "$("$0" completion)"; COMP_WORDS=("$0" test ex) COMP_CWORD=2; _tutorial'
    done = call("run", "bash", "-ec", f"{script}; echo ${{COMPREPLY[*]}}", tutorial)
    assert done == (0, "exercises\n")


@claim("A port that another program has is named")
def test_a_port_taken_by_another_program_is_named(call):
    with socket.create_server(("localhost", 0)) as taken:
        port = taken.getsockname()[1]
        uri = f"http://localhost:{port}"
        code, line = call("demo", "--for", "1", ROS_MASTER_URI=uri)
    assert (code, line.count("\n")) == (1, 1), line
    assert f"port {port} of localhost is taken by a program that is not a ROS master" in line


@claim("A check that cannot be set up blames no student")
def test_a_check_that_cannot_be_set_up_blames_no_student(call, tmp_path):
    workspace = str(tmp_path / "with space")
    code, output = call("check", "--in", str(tmp_path), TUTORIAL_WORKSPACE=workspace)
    why, verdict = output.splitlines()
    assert "set TUTORIAL_WORKSPACE to a path without spaces" in why
    assert verdict == "check: nothing was checked; this says nothing about your exercises"
    assert code == 2


@claim("The shell finds all, and changes no file of the user's")
def test_a_shell_sees_the_workspace_and_touches_no_file(tutorial, suite_workspace, tmp_path):
    home = tmp_path / "home"
    home.mkdir()
    (home / ".bashrc").write_text("alias mine=true\n")
    shell = subprocess.run(
        [tutorial, "shell"],
        input="pwd; alias mine; roscd joy2twist/launch; pwd; echo $CMAKE_POLICY_VERSION_MINIMUM\n"
        # as Tab does after: rosrun joy2twist joy2
        "COMP_WORDS=(rosrun joy2twist joy2) COMP_CWORD=2; _roscomplete_exe; echo ${COMPREPLY[0]}\n"
        "wget http://127.0.0.1:9/talker.py 2>&1 | tail -n 1\n"  # whether wget is installed or not
        "exit 3\n",
        env={"HOME": str(home), "PATH": "/usr/bin:/bin", "TUTORIAL_WORKSPACE": suite_workspace},
        cwd=tmp_path, capture_output=True, text=True, check=False, timeout=LONGEST_S,
    )  # fmt: skip
    assert shell.returncode == 3
    assert shell.stdout.splitlines() == [
        str(tmp_path),
        "alias mine='true'",
        f"{suite_workspace}/src/joy2twist/launch",
        "3.5",
        "joy2twist.py",
        "nothing was downloaded: type talker.py and listener.py as the handout lists them at the "
        "end of section 3",
    ]
    assert [path.name for path in home.iterdir() if path.name != ".bash_history"] == [".bashrc"]
    assert (home / ".bashrc").read_text() == "alias mine=true\n"


CPP = """\
#include <ros/ros.h>
#include <std_msgs/String.h>
void hear(const std_msgs::String::ConstPtr& text, int id) { ROS_INFO("%d", id); }
int main(int argc, char** argv) {
  ros::init(argc, argv, "hear");
  ros::NodeHandle node;
  auto sub = node.subscribe<std_msgs::String>("chatter", 10, boost::bind(&hear, _1, 7));
  ros::spin();
}
"""
STD = """\
#include <functional>
using namespace std::placeholders;  // _1 of another library
int add(int a, int b) { return a + b; }
auto add_one = std::bind(add, _1, 1);
"""
CMAKE = """\
cmake_minimum_required(VERSION 3.5)
project(cpp)
find_package(catkin REQUIRED COMPONENTS roscpp std_msgs)
catkin_package()
include_directories(${catkin_INCLUDE_DIRS})
foreach(program hear included)
  add_executable(${program} ${program}.cpp)
  target_link_libraries(${program} ${catkin_LIBRARIES})
endforeach()
add_library(without_ros std.cpp plain.c)
"""


@claim("C++ builds as the ROS wiki has it, `boost::bind(..., _1)`, and other C++ and C as before")
def test_cpp_builds_as_the_wiki_has_it(call, tmp_path):
    """boost::bind(..., _1), beside C, C++ without ROS, and a user's own flags and headers."""
    package = tmp_path / "ws/src/cpp"
    package.mkdir(parents=True)
    (tmp_path / "own").mkdir()
    files = {
        "../../../own/own.h": "#define NUMBER 7\n",
        "package.xml": MANIFEST.format("cpp", "roscpp</depend><depend>std_msgs"),
        "CMakeLists.txt": CMAKE,
        "hear.cpp": "#include <own.h>\n" + CPP.replace("7)", "NUMBER)"),
        "included.cpp": f"#include <boost/bind.hpp>\n{CPP}",
        "std.cpp": STD,
        "plain.c": "int new = sizeof 'a' == sizeof(int) ? 1 : -1;\n",
    }
    for name, text in files.items():
        (package / name).write_text(text)
    workspace = str(tmp_path / "ws")
    own = {"CXXFLAGS": "-Werror -Wpedantic", "CPLUS_INCLUDE_PATH": str(tmp_path / "own")}
    command = ("run", "--in", workspace, "catkin_make", "-C", workspace)
    code, output = call(*command, deadline_s=LONGEST_S, **own)
    assert code == 0 and "does not build" not in output, output


@claim("Of two calls at once one builds, and both go on")
def test_of_two_calls_at_once_one_builds_and_both_go_on(tutorial, tmp_path):
    command = [tutorial, "run", "--in", str(tmp_path / "catkin_ws"), "rospack", "find", "joy"]
    with Program(*command) as one, Program(*command) as other:
        assert (one.wait(), other.wait()) == (0, 0), one.output + other.output
        assert (one.output + other.output).count("tutorial: building") == 1


@claim(
    "The first build of a student's workspace shows CMake's message, in English in every terminal"
)
def test_the_first_build_shows_an_error_of_cmake_with_its_message_in_english(call, tmp_path):
    package = tmp_path / "src" / "mine"
    package.mkdir(parents=True)
    about = "<version>0.0.1</version><description>d</description><license>BSD</license>"
    person = '<maintainer email="ada@example.com">Ada</maintainer>'
    xml = f'<package format="2"><name>mine</name>{about}{person}</package>'
    (package / "package.xml").write_text(xml)
    (package / "CMakeLists.txt").write_text('message(FATAL_ERROR "no part, in $ENV{LC_ALL}")')
    code, output = call("run", "--in", str(tmp_path), "echo", "went on", LC_ALL="de_DE.UTF-8")
    assert re.search(r"^   CMake Error at .*\n     no part, in C\.UTF-8$", output, re.MULTILINE)
    assert (code, output.count("does not build")) == (0, 1) and output.endswith("went on\n")


@claim("A broken package.xml is named before all fails over it")
def test_a_broken_package_xml_is_named_before_everything_fails_over_it(call, tmp_path):
    package = tmp_path / "src" / "mine" / "package.xml"
    command = ["run", "--in", str(tmp_path), "true"]
    assert call(*command)[0] == 0
    package.parent.mkdir(parents=True)
    package.write_text("<package>\n<name>mine</nam>\n</package>")
    code, output = call(*command)
    assert (code, output.count("\n")) == (0, 1) and f"{package}: mismatched tag: line 2" in output
    _, output = call("doctor", "--in", str(tmp_path))
    assert f"wrong    overlay      {package}: mismatched tag: line 2" in output
