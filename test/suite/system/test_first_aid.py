"""The problems that beginners of ROS 1 report most, as TROUBLE.md and the doctor answer them.

A bash script causes each problem, if this machine can. The output must contain the page's sentence,
in which "..." stands for names, and the doctor's words, if the script runs it.
"""

import re
import shutil

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY, Program
from tutorial_testing.waiting import LONGEST_S

pytestmark = claim(
    "The problems of beginners, also of Pythons, ROS 2 and workspaces of a terminal: the page has "
    "the sentence that is printed, the doctor its words"
)
PATH = REPOSITORY / "common/doc/TROUBLE.md"
PAGE = PATH.read_text()
SENTENCES = PAGE.split("## By message")[1].split("## By what you see")[0]
CELLS = re.findall(r"^\| (`.*?) \| (.*) \|$", SENTENCES, re.M)
# What the scripts share: a package in a workspace in their folder, a master, the doctor.
COMMON = r"""
cd "$0"
trap 'kill $(jobs -p) 2>/dev/null; wait' EXIT
tools=$(rospack find tutorial_tools)
doctor() { echo DOCTOR; /usr/bin/python3 "$tools/scripts/doctor.py"; }
bare() { env -i PATH=/usr/bin:/bin HOME="$HOME" CMAKE_POLICY_VERSION_MINIMUM=3.5 "$@"; }
nodes() { # the launch file with the node a.py, and these attributes
    echo "<launch><node pkg='mine' type='a.py' name='a' required='true' $1/></launch>" >a.launch
    export ROS_PACKAGE_PATH=$PWD/ws/src:$ROS_PACKAGE_PATH
}
package() {
    mkdir -p ws/src/mine/scripts
    echo '<package format="2"><name>mine</name><version>0.0.1</version><description>d</description>
        <maintainer email="ada@example.com">Ada</maintainer><license>BSD</license>
        <buildtool_depend>catkin</buildtool_depend></package>' >ws/src/mine/package.xml
    printf 'cmake_minimum_required(VERSION 3.5)\nproject(mine)\nfind_package(catkin REQUIRED %s)
        catkin_package()\n' "$1" >ws/src/mine/CMakeLists.txt
}
master() {
    roscore -p "${ROS_MASTER_URI##*:}" >/dev/null 2>&1 &
    until rosparam get /run_id >/dev/null 2>&1; do sleep 0.1; done
}
made_of() { # CMAKE
    echo "$1" >>ws/src/mine/CMakeLists.txt
    (cd ws && bare env LC_ALL=C.UTF-8 catkin_make)
}
until_it_says() { # WORDS COMMAND ...
    touch said
    "${@:2}" >said 2>&1 &
    until grep -q "$1" said; do sleep 0.1; done
    cat said
}
python() { PYTHONPATH=$1:$PYTHONPATH /usr/bin/python3 "${@:2}"; }
"""
# Of each problem: the page's sentence, the script that causes it, and after > the doctor's words.
MADE = r"""
add_executable cannot create target "..." because another target with the same name already exists
    package; echo 'int main() {}' >ws/src/mine/a.cpp
    made_of 'add_executable(a a.cpp)
        add_executable(a a.cpp)'
fatal error: ....h: No such file or directory
    package; echo '#include "ros/Ros.h"' >ws/src/mine/a.cpp; made_of 'add_executable(a a.cpp)'
multiple definition of ...
    package; echo 'int main() {}' | tee ws/src/mine/a.cpp >ws/src/mine/b.cpp
    made_of 'add_executable(a a.cpp b.cpp)'
undefined reference to ...
    package; echo 'void f(); int main() { f(); }' >ws/src/mine/a.cpp
    made_of 'add_executable(a a.cpp)'
You must call ros::init() before creating the first NodeHandle
    package 'COMPONENTS roscpp'
    printf '#include <ros/ros.h>\nros::NodeHandle n;\nint main() {}\n' >ws/src/mine/a.cpp
    made_of 'add_executable(a a.cpp)
        target_link_libraries(a ${catkin_LIBRARIES})'
    ws/devel/lib/mine/a
Unable to register with master node ...
    until_it_says Unable rosrun beginner_tutorials talker.py; doctor
  > nothing listens on its port: start roscore
RLException: roscore cannot run as another roscore/master is already running
    master; roscore -p ${ROS_MASTER_URI##*:}
[rospack] Error: package '...' not found
    rospack find nowhere
Couldn't find executable named ...
    package; touch ws/src/mine/scripts/a.py; ROS_PACKAGE_PATH=$PWD/ws/src rosrun mine a.py
Couldn't find executable named ...
    package; ROS_PACKAGE_PATH=$PWD/ws/src:$ROS_PACKAGE_PATH rosrun mine a_node_in_cpp
RLException: [...] is neither a launch file in package [...]
    roslaunch joy2twist x.launch
No module named 'rospkg'
    mkdir conda; printf '#!/bin/sh\nexec /usr/bin/python3 -I -S "$@"' >conda/python3
    chmod +x conda/python3; export PATH=$PWD/conda:$PATH; python3 -c 'import rospkg'; doctor
  > which has no rospkg, catkin_pkg, em: conda deactivate
module 'em' has no attribute 'RAW_OPT'
    export PYTHONUSERBASE=$PWD/user
    site=$(/usr/bin/python3 -c 'import site; print(site.getusersitepackages())')
    mkdir -p "$site"; echo 'class Interpreter: pass' >"$site/em.py"; echo 'int8 a' >A.msg
    make='t.generate_from_file("A.msg", "mine", ".", ".", {}, {"x.template": "@NAME@.h"}, {})'
    python . -c "import genmsg.template_tools as t; $make"; doctor
  > which is not empy 3: no message is built: /usr/bin/python3 -m pip uninstall
The build space at '...' was previously built by 'catkin build'
    package; mkdir ws/build; echo catkin build >ws/build/.built_by
    (cd ws && bare catkin_make); TUTORIAL_IN=$PWD/ws doctor
  > ws/build was made by catkin build, not by catkin_make: cd
CMake Error: The current CMakeCache.txt directory ... is different than the directory
    package; (cd ws && bare catkin_make >/dev/null); mv ws moved
    (cd moved && bare catkin_make); TUTORIAL_IN=$PWD/moved doctor
  > ws/src: cd
ROS_DISTRO was set to '...' before. Please make sure that the environment does not mix paths
    ROS_DISTRO=jazzy; . "${CMAKE_PREFIX_PATH%%:*}/setup.bash"
    export AMENT_PREFIX_PATH=$PWD/jazzy PYTHONPATH=$PWD/jazzy/lib:$PYTHONPATH
    mkdir -p jazzy/lib/std_msgs; echo 'raise ImportError' >jazzy/lib/std_msgs/__init__.py; doctor
  > ROS 2 is in this terminal, too
setup.bash:.:8: no such file or directory: .../setup.sh
    LC_ALL=C.UTF-8 zsh -c "source ${CMAKE_PREFIX_PATH%%:*}/setup.bash"
qt.qpa.xcb: could not connect to display
    DISPLAY=:9999 timeout 20 $(command -v rviz)
/usr/bin/env: ‘python3\r’: No such file or directory
    package; printf '#!/usr/bin/env python3\r\n' >ws/src/mine/scripts/a.py
    chmod +x ws/src/mine/scripts/a.py; LC_ALL=C.UTF-8 ws/src/mine/scripts/a.py
    TUTORIAL_IN=$PWD/ws doctor
  > a.py has the line ends of Windows: sed
mismatched tag: line ...
    package; echo '<package></name>' >ws/src/mine/package.xml
    export ROS_PACKAGE_PATH=$PWD/ws/src:$ROS_PACKAGE_PATH; roslaunch joy2twist x.launch; doctor
  > package.xml: mismatched tag: line 1
No messages received and simulated time is active. Is /clock being published?
    master; rosparam set /use_sim_time true
    until_it_says 'Is /clock' rostopic echo /rosout_agg; doctor
  > /use_sim_time is true, and no /clock arrives: rosparam delete
Could not find a package configuration file provided by "..."
    package 'COMPONENTS nowhere'; cd ws && bare catkin_make
process has died [pid ..., exit code ...]
    package; printf '#!/bin/sh\nexit 3\n' >ws/src/mine/scripts/a.py
    chmod +x ws/src/mine/scripts/a.py; nodes; roslaunch a.launch
cannot launch node of type [...]: Cannot locate node of type
    package; echo '#!/usr/bin/python3' >ws/src/mine/scripts/a.py; nodes
    until_it_says 'Cannot locate' roslaunch a.launch; TUTORIAL_IN=$PWD/ws doctor
  > scripts/a.py is not executable: chmod +x
import: command not found
    package; echo 'import rospy' >ws/src/mine/scripts/a.py
    chmod +x ws/src/mine/scripts/a.py; nodes; LC_ALL=C.UTF-8 rosrun mine a.py
    TUTORIAL_IN=$PWD/ws doctor
  > scripts/a.py does not begin with #!: sed
you may be missing a '#!' declaration
    package; echo 'import rospy' >ws/src/mine/scripts/a.py
    chmod +x ws/src/mine/scripts/a.py; nodes; roslaunch a.launch; TUTORIAL_IN=$PWD/ws doctor
  > scripts/a.py does not begin with #!: sed
RLException: Roslaunch got a 'No such file or directory' error
    package; printf '#!/bin/sh\n' >ws/src/mine/scripts/a.py; chmod +x ws/src/mine/scripts/a.py
    nodes "launch-prefix='no_xterm -e'"; roslaunch a.launch
The specified source space "..." does not exist
    mkdir ws; cd ws; bare catkin_make
Multiple packages found with the same name
    package; cp -r ws/src/mine ws/src/copy; (cd ws && bare catkin_make); TUTORIAL_IN=$PWD/ws doctor
  > packages have the name mine:
Unable to contact my own server at
    echo '<launch/>' >a.launch; export ROS_IP=192.0.2.7; roslaunch a.launch; doctor
  > ROS_IP=192.0.2.7 is no address of this machine
Could not process inbound connection: topic types do not match
    master; listen='rospy.Subscriber("chatter", std_msgs.msg.Int32, print); rospy.spin()'
    /usr/bin/python3 -c "import rospy, std_msgs.msg; rospy.init_node('a'); $listen" &
    until_it_says inbound rosrun beginner_tutorials talker.py; doctor
  > std_msgs/Int32 is wanted by /a
Cannot load message class for
    master; send='rospy.Publisher("num", Num, queue_size=1); rospy.spin()'
    make="Num = type('Num', (std_msgs.msg.String,), {'_type': 'mine/Num'})"
    /usr/bin/python3 -c "import rospy, std_msgs.msg; rospy.init_node('a'); $make; a = $send" &
    until rostopic type /num; do sleep 0.1; done; rostopic echo -n 1 num
'_1' was not declared in this scope
    printf '#include <ros/ros.h>\nvoid f(int) {}\nint main() { boost::bind(f, _1)(1); }\n' >a.cpp
    flags=$(sed -n "s/.*'_1' was.*CXXFLAGS='\(.*\)'.*/\1/p" "$PAGE")
    bare g++ -fsyntax-only $flags a.cpp && bare g++ -fsyntax-only a.cpp
Invalid roslaunch XML syntax: [Errno 2] No such file
    echo '<launch><include file="$(find joy2twist)/x.launch"/></launch>' >a.launch
    roslaunch a.launch
RLException: Invalid roslaunch XML syntax
    echo '<launch><node></launch>' >a.launch; roslaunch a.launch
RLException: Invalid <param> tag: Cannot load command parameter
    roslaunch joy2twist launch_bag.launch rviz:=maybe
"""  # noqa: RUF001
MADE = re.findall(r"^(\S.*)\n((?: {4}.*\n)+)(?:  > (.*))?", MADE, re.M)
# Problems without a script: the sentence, and why, or which test covers the answer.
NOT_MADE = {
    "EXPKEYSIG F42ED6FBAB17C654 Open Robotics": "needs the archive of packages.ros.org: not tested",
    "No permission to read /dev/input/js0": "root may read all: test_doctor_judgement.py",
    "SyntaxError: Missing parentheses in call to 'print'": "Python's own",
    "IndentationError": "Python's own",
    "but our version has": "rospy's own",
    "new node registered with same name": "starts.py",
    "TF_OLD_DATA ignoring data from the past": "doctor_findings.py",
    "Lookup would require extrapolation": "doctor_findings.py",
    "because they are not part of the same tree": "test_doctor_judgement.py",
    "networkingMode=mirrored": "needs Windows: test_doctor_judgement.py",
}


def test_the_page_has_each_problem_where_one_looks():
    assert len(MADE) + len(NOT_MADE) == 46
    for sentence in NOT_MADE:
        assert sentence in PAGE
    firsts = [cell.split("`")[1].casefold() for cell, _ in CELLS]
    order = [re.sub("[^a-z0-9]+", " ", first).strip() for first in firsts]
    assert order == sorted(order)


@pytest.mark.parametrize(("sentence", "script", "words"), MADE, ids=[row[0] for row in MADE])
def test_the_sentence_that_a_beginner_reads(sentence, script, words, tmp_path, master_uri):
    (answer,) = (answer for cell, answer in CELLS if f"`{sentence}`" in cell)
    for program in ("zsh", "rviz"):
        if program in script and not shutil.which(program):
            pytest.skip(f"no {program} here")
    given = {"ROS_MASTER_URI": master_uri, "TUTORIAL_IN": "", "PAGE": str(PATH)}
    with Program("bash", "-c", COMMON + script, str(tmp_path), **given) as program:
        program.wait(LONGEST_S)
        output = program.output
    said = " ".join(output.split())
    shape = ".*".join(map(re.escape, sentence.split("...")))
    assert re.search(shape, said, re.IGNORECASE), output
    doctors = said.rpartition("DOCTOR ")[2] if words else ""
    assert words in doctors and "Traceback" not in doctors, output
    if "find executable" in sentence:  # one sentence for two problems
        assert "chmod +x" in answer and "add_executable" in answer
