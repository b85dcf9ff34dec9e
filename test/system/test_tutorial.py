"""./tutorial as a user calls it: what it prints, its exit code, what it leaves behind."""

import os
import re
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

import pytest

from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program
from tutorial_testing.waiting import BUSY_S, DEADLINE_S, wait_for

BAG = Path(__file__).resolve().parents[2] / "joy2twist" / "bag" / "joy.bag"
LINE = re.compile(
    r"^demo: (?P<seconds>[\d.]+) s: (?P<joy>\d+) /joy, (?P<cmd_vel>\d+) /cmd_vel, "
    r"(?P<odom>\d+) /odom; driven (?P<driven>[\d.]+) m; "
    r"final pose x -?[\d.]+ m, y -?[\d.]+ m, yaw -?[\d.]+ deg$",
    re.MULTILINE,
)
FASTEST_M_PER_S = 0.7  # a TurtleBot 2
SOON_S = 30.0  # generous: two bare machines at a time run their tests beside this one
# For what is not about the page or the view: the demonstration works less.
BARE = ("rviz:=false", "cockpit:=false")
DRIVEN = """
import rospy
from nav_msgs.msg import Odometry
rospy.init_node("look", anonymous=True, log_level=rospy.ERROR)
while rospy.wait_for_message("/odom", Odometry, 30).twist.twist.linear.x < 0.1:
    pass
"""


def refuse(*command):
    """Run a command that must fail; return the line in which it says why."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=DEADLINE_S)
    assert done.returncode not in (0, 124)
    assert "Traceback" not in done.stdout + done.stderr
    lines = [line for line in done.stderr.splitlines() if not line.startswith("usage:")]
    assert len(lines) == 1, done.stderr
    return lines[0]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["frobnicate"], 'tutorial: "frobnicate" is not a word'),
        (
            ["test", "everything"],
            'test: "everything" is none of unit launch ros system again',
        ),
        (["setup", "moon"], 'setup: "moon" is not system or workspace'),
        (["bench", "moon"], 'bench: "moon" has no folder'),
        (["run"], "run: a command is missing"),
        (["run", "rosrun", "rviz", "rviz", "-d", "x"], "run: no screen for RViz"),
        (["run", "no_such_command"], 'run: there is no command "no_such_command"'),
        (["demo", "colour:=red"], "demo: colour:=red: not an argument of launch_bag.launch"),
        (["demo", "--for", "ever"], "ever: not a time in seconds"),
        (["demo", "bag:=/no/such.bag"], "demo: /no/such.bag: cannot be read: No such file"),
    ],
)
def test_a_mistake_gets_one_clear_line(tutorial, monkeypatch, arguments, expected):
    monkeypatch.delenv("DISPLAY", raising=False)
    assert expected in refuse(tutorial, *arguments)


def test_no_word_at_all_shows_the_words(tutorial):
    done = subprocess.run(
        [tutorial], capture_output=True, text=True, check=False, timeout=DEADLINE_S
    )
    assert done.returncode == 2
    for word in ("demo", "test", "bench", "doctor", "setup", "shell", "run"):
        assert re.search(rf"^  {word}\b", done.stderr, re.MULTILINE)


# A system on which nothing is installed yet. LACKING: what its archive has not; SLOW: download or
# install, which then lasts until the file `go_on` is there; BROKEN: no network.
FAKES = {
    "dpkg-query": """
        touch installed
        for name in "$@"; do ! grep -qx -e "$name" installed || echo "installed $name"; done""",
    "apt-cache": """
        shift
        for name in "$@"; do
            [[ " $LACKING " == *" $name "* ]] || printf '%s:\\n  Candidate: 1\\n' "$name"
        done""",
    "apt-get": """
        echo "$*" >>calls
        last() {
            [ "$SLOW" = "$1" ] || return 0
            touch "slow_$1"
            until [ -e go_on ]; do sleep 0.05; done
        }
        if [ -n "$BROKEN" ]; then echo 'Err:1 no network' ; [[ $* == *" update" ]]; exit; fi
        case $* in
        *" update") ;;
        'install -s'*) for name in $LACKING; do [[ " $* " != *" $name "* ]] || exit 100; done ;;
        *--download-only*)
            echo dlstatus:1:50.0:words >&3
            last download
            ;;
        *)
            echo pmstatus:package:50.0:words >&3
            last install
            printf '%s\\n' "$@" >>installed
            ;;
        esac""",
    "id": "echo 1000",  # not root, so by sudo, which closes all file descriptors above 2
    "sudo": """
        for number in {3..99}; do eval "exec $number>&-"; done
        exec "$@" """,
}


@pytest.fixture
def bare_system(tutorial, tmp_path, monkeypatch, clean_environment):
    """A folder for FAKES and their files; programs that start see them instead of Debian's."""
    for name, script in FAKES.items():
        (tmp_path / name).write_text(f"#!/bin/bash\ncd '{tmp_path}'\n{script}\n")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    # What is built is built; only the list of what the archive lacks is another.
    workspace = subprocess.run(
        [tutorial, "run", "bash", "-c", "dirname ${CMAKE_PREFIX_PATH%%:*}"],
        env={**clean_environment, "PATH": "/usr/bin:/bin"},
        check=True, capture_output=True, text=True, timeout=DEADLINE_S,
    ).stdout.strip()  # fmt: skip
    (tmp_path / "ws").mkdir()
    for name in ("built", "devel", "python"):
        (tmp_path / "ws" / name).symlink_to(f"{workspace}/{name}")
    monkeypatch.setenv("TUTORIAL_WORKSPACE", str(tmp_path / "ws"))
    for name in ("LACKING", "SLOW", "BROKEN"):
        monkeypatch.setenv(name, "")
    return tmp_path


@pytest.mark.usefixtures("bare_system")
def test_set_up_by_sudo_shows_how_far_it_is(tutorial):
    with Program(tutorial, "setup", "system") as setup:
        assert setup.wait() == 0, setup.output
        assert "tutorial:    download 50 %\ntutorial:    install 50 %\n" in setup.output


def test_what_the_archive_lacks_is_said_once_and_done_without(tutorial, bare_system, monkeypatch):
    monkeypatch.setenv("LACKING", "rviz graphviz")
    with Program(tutorial, "run", "true") as first:
        assert first.wait() == 0, first.output
        line = r"^tutorial: done without, as the archive of .* lacks it: rviz graphviz$"
        assert len(re.findall(line, first.output, re.MULTILINE)) == 1, first.output
    with Program(tutorial, "run", "true") as second:
        assert second.wait() == 0
        assert second.output == ""
    monkeypatch.setenv("LACKING", "")
    with Program(tutorial, "setup", "system") as later:  # looks again
        assert later.wait() == 0
    assert {"rviz", "graphviz"} <= set((bare_system / "installed").read_text().split())


def test_an_archive_without_what_drives_is_named(tutorial, bare_system, monkeypatch):
    monkeypatch.setenv("LACKING", "rviz python3-rospy")
    with Program(tutorial, "demo") as demo:
        assert demo.wait() == 1
        assert "lacks python3-rospy, without which nothing drives" in demo.output
        assert "network" not in demo.output
    assert not (bare_system / "installed").read_text()


@pytest.mark.usefixtures("bare_system")
def test_without_a_network_it_says_so(tutorial, monkeypatch):
    monkeypatch.setenv("BROKEN", "yes")
    with Program(tutorial, "demo") as demo:
        assert demo.wait() == 1
        assert re.search(r"Err:1 no network\n.* not installed: .*Check the network", demo.output)


INTERRUPTED = "tutorial: interrupted; ./tutorial setup goes on where it stopped"


def test_ctrl_c_ends_a_download_quietly(tutorial, bare_system, monkeypatch):
    monkeypatch.setenv("SLOW", "download")
    with Program(tutorial, "demo") as demo:
        wait_for((bare_system / "slow_download").exists, "download")
        demo.interrupt()
        assert demo.wait() == 130
        assert demo.output.splitlines()[1:] == ["tutorial:    download 50 %", INTERRUPTED]
        wait_for(lambda: not demo.left_behind(), "end of apt-get")


def test_ctrl_c_waits_for_dpkg_and_says_so(tutorial, bare_system, monkeypatch):
    monkeypatch.setenv("SLOW", "install")
    with Program(tutorial, "demo") as demo:
        wait_for((bare_system / "slow_install").exists, "installation")
        demo.interrupt()
        wait_for(lambda: "is finished first, as dpkg must not be cut" in demo.output, "word of it")
        assert not demo.ended
        (bare_system / "go_on").touch()
        assert demo.wait() == 130
        assert demo.output.splitlines()[-1] == INTERRUPTED
    assert "python3-rospy\n" in (bare_system / "installed").read_text()


def test_without_pypi_only_replay_bag_is_missing(tutorial, bare_system):
    """Nothing answers there; it is told once."""
    with Program(tutorial, "setup", "system") as setup:
        assert setup.wait() == 0
    (bare_system / "ws" / "python").unlink()
    offline = {
        "PIP_INDEX_URL": "http://localhost:9/", "PIP_RETRIES": "0", "PIP_NO_CACHE_DIR": "1",
        "PIP_CONFIG_FILE": "/dev/null", "PIP_EXTRA_INDEX_URL": "", "PIP_FIND_LINKS": "",
    }  # fmt: skip
    with Program(tutorial, "run", "echo", "went on", **offline) as first:
        assert first.wait() == 0
        assert "not installed from PyPI: rosbags vermin" in first.output.replace("\n", " ")
        assert first.output.endswith("tutorial: all but replay_bag works without\nwent on\n")
    with Program(tutorial, "run", "echo", "went on", **offline) as second:
        assert second.wait() == 0
        assert second.output == "went on\n"


def test_a_truncated_bag_gets_one_clear_line(tutorial, tmp_path):
    bag = tmp_path / "truncated.bag"
    bag.write_bytes(BAG.read_bytes()[:30])
    assert f"demo: {bag}: " in refuse(tutorial, "demo", f"bag:={bag}")


def test_a_port_taken_by_another_program_is_named(tutorial, monkeypatch):
    with socket.create_server(("localhost", 0)) as taken:
        port = taken.getsockname()[1]
        monkeypatch.setenv("ROS_MASTER_URI", f"http://localhost:{port}")
        line = refuse(tutorial, "demo", "--for", "1")
    assert f"port {port} of localhost is taken by a program that is not a ROS master" in line


def test_a_bad_master_uri_is_named(tutorial, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", "moon")
    assert "ROS_MASTER_URI=moon" in refuse(tutorial, "demo", "--for", "1")


def check_demo(program, seconds):
    """The demonstration ran for a time: its line, its counts, its exit code."""
    assert program.wait(seconds + DEADLINE_S) == 0, program.output
    told = LINE.search(program.output)
    assert told, program.output
    for topic in ("joy", "cmd_vel", "odom"):
        assert int(told[topic]) == pytest.approx(50 * seconds, rel=0.2)
    assert float(told["driven"]) > 0.3
    assert "Traceback" not in program.output
    wait_for(lambda: not program.left_behind(), "end of every process")


@pytest.mark.usefixtures("master_uri")
def test_demo_counts_and_drives(tutorial):
    with Program(tutorial, "demo", "--for", "5", "rviz:=false") as demo:
        check_demo(demo, 5)


@pytest.mark.usefixtures("master_uri")
def test_demo_shows_odometry_soon(tutorial):
    """The best of some tries, as this machine may be busy: alone it takes some 4 s."""
    needed = []
    while len(needed) < 5 and not any(seconds < SOON_S for seconds in needed):
        with Program(tutorial, "demo", "--for", "0.5", "rviz:=false") as demo:
            demo.wait()
            told = re.search(r"^demo: first /odom after ([\d.]+) s$", demo.output, re.MULTILINE)
            assert told, demo.output
            needed.append(float(told[1]))
    assert min(needed) < SOON_S


def test_demo_uses_a_master_that_runs_and_leaves_it(tutorial, master_uri):
    port = master_uri.rsplit(":", 1)[1]
    with Program(tutorial, "run", "roscore", "-p", port) as roscore:
        wait_for(lambda: "started core service" in roscore.output, "roscore")
        with Program(tutorial, "demo", "--for", "4", *BARE) as demo:
            check_demo(demo, 4)
        assert not roscore.ended
        roscore.interrupt()
        assert roscore.wait() == 0


def test_demo_says_so_when_the_robot_stands(tutorial, tmp_path, master_uri):
    still = tmp_path / "still.bag"
    subprocess.run(
        [tutorial, "run", "rosbag", "filter", str(BAG), str(still), "not any(m.axes)"],
        check=True, capture_output=True, timeout=DEADLINE_S,
    )  # fmt: skip
    with Program(tutorial, "demo", "--for", "2", *BARE, f"bag:={still}") as demo:
        assert demo.wait() == 1
        assert "driven 0.00 m" in demo.output
    assert master_uri


@pytest.mark.usefixtures("master_uri")
@pytest.mark.parametrize("sign", ["process[fake_turtlebot", "process[rosbag", "first /odom"])
def test_demo_ends_cleanly_on_ctrl_c(tutorial, sign):
    """While the nodes still load, and later; nothing is left behind."""
    with Program(tutorial, "demo", "--for", "600", "rviz:=false") as demo:
        wait_for(lambda: sign in demo.output, sign)
        demo.interrupt()
        assert demo.wait() == 130
        wait_for(lambda: not demo.left_behind(), "end of every process")
        # Python has a traceback for whoever interrupts it in its very first milliseconds.
        assert sign != "first /odom" or "Traceback" not in demo.output


@pytest.mark.usefixtures("master_uri")
def test_demo_tells_the_drive_when_ctrl_c_ends_it(tutorial):
    with Program(tutorial, "demo", *BARE) as demo:
        wait_for(lambda: "first /odom" in demo.output, "robot")
        began_s = time.monotonic()
        with Program(tutorial, "run", "python3", "-c", DRIVEN) as look:
            assert look.wait() == 0, look.output
        demo.interrupt()
        took_s = time.monotonic() - began_s
        assert demo.wait() == 0, demo.output
        told = LINE.findall(demo.output)
        assert len(told) == 1, demo.output
        assert demo.output.endswith(f"{LINE.search(demo.output)[0]}\n")
        assert float(LINE.search(demo.output)["seconds"]) == pytest.approx(took_s, abs=BUSY_S)
        assert float(LINE.search(demo.output)["driven"]) > 0.0
        wait_for(lambda: not demo.left_behind(), "end of every process")


IN_TERMINAL = "in another terminal: ./tutorial run rostopic echo /odom/pose/pose/position"


@pytest.mark.usefixtures("master_uri")
@pytest.mark.parametrize(
    ("arguments", "look"),
    [
        (["cockpit_port:={port}"], "to see it drive, open http://127.0.0.1:{port}/ in a browser"),
        (["cockpit:=false"], f"to see it drive, {IN_TERMINAL}"),
        ([*BARE], None),  # who said so need not be told
    ],
)
def test_demo_says_where_to_look_without_a_screen(tutorial, arguments, look):
    port = free_port()
    arguments = [argument.format(port=port) for argument in arguments]
    with Program(tutorial, "demo", "--for", "0.5", *arguments, DISPLAY="") as demo:
        demo.wait()
        lines = [line for line in demo.output.splitlines() if "RViz is left out" in line]
        expected = [True] if look else []
        assert [look.format(port=port) in line for line in lines] == expected, demo.output


OWN = re.compile(r"export ROS_MASTER_URI=http://localhost:(\d+)$")


def check_refusal(line, master_uri, names):
    """A demonstration was refused because nodes run; the line says which, and what to do."""
    runs = "run" if " and " in names else "runs"
    assert line.startswith(f"demo: {names} {runs} already on {master_uri}; end "), line
    assert int(OWN.search(line)[1]) > int(master_uri.rsplit(":", 1)[1])


def test_a_second_demo_is_refused_and_the_first_drives_on(tutorial, master_uri):
    names = "/fake_turtlebot, /myjoystick2twist, /robot_state_publisher and /rosbag"
    with Program(tutorial, "demo", "--for", "600", *BARE) as first:
        wait_for(lambda: "first /odom" in first.output, "robot")
        check_refusal(refuse(tutorial, "demo", "--for", "1"), master_uri, names)
        with Program(tutorial, "run", "python3", "-c", DRIVEN) as look:
            assert look.wait() == 0, look.output
        first.interrupt()
        assert first.wait() == 130


@pytest.mark.usefixtures("master_uri")
def test_of_two_demos_that_start_at_once_one_drives(tutorial):
    both = [Program(tutorial, "demo", "--for", "4", *BARE) for _ in range(2)]
    with both[0], both[1]:
        wait_for(lambda: both[0].ended or both[1].ended, "end of one")
        refused, drives = sorted(both, key=lambda program: program.ended, reverse=True)
        assert refused.wait() == 1
        assert " already on " in refused.output, refused.output
        assert len(refused.output.splitlines()) == 1
        check_demo(drives, 4)


def test_demo_is_refused_beside_another_sender_but_not_beside_a_dead_node(tutorial, master_uri):
    def start(*command):
        return Program(tutorial, "run", *command)

    def known(name):
        with start("rosnode", "list") as listing:
            assert listing.wait() == 0, listing.output
            return name in listing.output.splitlines()

    with start("roscore", "-p", master_uri.rsplit(":", 1)[1]) as roscore:
        wait_for(lambda: "started core service" in roscore.output, "roscore")
        sender = ("rostopic", "pub", "-r", "1", "/joy", "sensor_msgs/Joy", "{}", "__name:=sender")
        with start(*sender) as rival:
            wait_for(lambda: known("/sender"), "sender")
            check_refusal(refuse(tutorial, "demo", "--for", "1"), master_uri, "/sender")
            rival.interrupt()
            rival.wait()
        with start("rosrun", "fake_turtlebot_sim", "fake_turtlebot.py") as robot:
            wait_for(lambda: known("/fake_turtlebot"), "robot")
            check_refusal(refuse(tutorial, "demo", "--for", "1"), master_uri, "/fake_turtlebot")
            for pid in robot.left_behind():
                os.kill(pid, signal.SIGKILL)
            robot.wait()
        assert known("/fake_turtlebot")
        with Program(tutorial, "demo", "--for", "4", *BARE) as demo:
            check_demo(demo, 4)
        roscore.interrupt()
        roscore.wait()


@pytest.mark.usefixtures("master_uri")
def test_demo_counts_no_messages_of_other_nodes(tutorial):
    far = "{pose: {pose: {position: {x: 100}}}}"
    publish = ("run", "rostopic", "pub", "-r", "200", "/odom", "nav_msgs/Odometry", far)
    with Program(tutorial, "demo", "--for", "6", *BARE) as demo:
        wait_for(lambda: "first /odom" in demo.output, "robot")
        with Program(tutorial, *publish) as other:
            check_demo(demo, 6)
            assert not other.ended, other.output
        assert float(LINE.search(demo.output)["driven"]) < 6 * FASTEST_M_PER_S


@pytest.mark.usefixtures("master_uri", "clean_environment")
def test_a_clone_below_a_path_with_spaces_beside_another_python(clone, tmp_path, monkeypatch):
    """What a user's machine may have: spaces in the path, a python3 without ROS first on PATH."""
    other = tmp_path / "bin"
    other.mkdir()
    (other / "python3").write_text("#!/bin/sh\necho 'not the Python of ROS' >&2\nexit 1\n")
    (other / "python3").chmod(0o755)
    monkeypatch.setenv("PATH", str(other), prepend=":")
    monkeypatch.setenv("TUTORIAL_WORKSPACE", str(tmp_path / "ws"))
    with Program(str(clone / "tutorial"), "demo", "--for", "4", *BARE) as demo:
        wait_for(lambda: "first /odom" in demo.output or demo.ended, "workspaces and robot", 300)
        check_demo(demo, 4)
        assert "not the Python of ROS" not in demo.output
    shutil.rmtree(tmp_path / "ws")


def test_a_workspace_path_with_spaces_is_refused(clone, tmp_path, monkeypatch):
    monkeypatch.setenv("TUTORIAL_WORKSPACE", str(tmp_path / "my ws"))
    line = refuse(str(clone / "tutorial"), "setup", "workspace")
    assert "set TUTORIAL_WORKSPACE to a path without spaces" in line


@pytest.mark.parametrize("started_by", ["roscore", "roslaunch"])
def test_a_master_has_what_rospy_would_ask_for_with_every_line(tutorial, master_uri, started_by):
    port = master_uri.rsplit(":", 1)[1]
    launch = ["beginner_tutorials", "talker_listener.launch"] * (started_by == "roslaunch")
    with Program(tutorial, "run", started_by, "-p", port, *launch) as master:
        wait_for(lambda: "process[rosout-1]: started" in master.output, "rosout")
        asked = ["rosparam", "get", "/rosout_disable_topics_generation"]
        done = subprocess.run([tutorial, "run", *asked], capture_output=True, check=True, text=True)
        assert done.stdout.strip() == "false"
        master.interrupt()
        master.wait()


@pytest.mark.usefixtures("clean_environment")
def test_what_is_kept_of_the_environment_is_what_setup_bash_sets(tutorial):
    script = """
        show() { echo "$CMAKE_PREFIX_PATH $ROS_PACKAGE_PATH $PYTHONPATH"; }
        show; . "${CMAKE_PREFIX_PATH%%:*}/setup.bash"; show"""
    done = subprocess.run(
        [tutorial, "run", "bash", "-c", script], capture_output=True, text=True, check=True
    )
    kept, set_anew = done.stdout.splitlines()
    assert kept == set_anew


def test_shell_and_run_see_the_workspace_and_no_shell_file_is_touched(tutorial, tmp_path):
    home = tmp_path / "home"
    home.mkdir()
    (home / ".bashrc").write_text("alias mine=true\n")
    workspace = subprocess.run(
        [tutorial, "run", "bash", "-c", "dirname ${CMAKE_PREFIX_PATH%%:*}"],
        check=True, capture_output=True, text=True, timeout=DEADLINE_S,
    ).stdout.strip()  # fmt: skip
    shell = subprocess.run(
        [tutorial, "shell"],
        input="pwd; alias mine; roscd joy2twist/launch; pwd; echo $CMAKE_POLICY_VERSION_MINIMUM\n"
        # As Tab does after: rosrun joy2twist joy2
        "COMP_WORDS=(rosrun joy2twist joy2) COMP_CWORD=2; _roscomplete_exe; echo ${COMPREPLY[0]}\n"
        "exit 3\n",
        env={
            "HOME": str(home),
            "PATH": "/usr/bin:/bin",
            "TUTORIAL_WORKSPACE": workspace,
        },
        cwd=tmp_path, capture_output=True, text=True, check=False, timeout=DEADLINE_S,
    )  # fmt: skip
    assert shell.returncode == 3
    assert shell.stdout.splitlines() == [
        str(tmp_path),
        "alias mine='true'",
        f"{workspace}/src/joy2twist/launch",
        "3.5",
        "joy2twist.py",
    ]
    assert [path.name for path in home.iterdir() if path.name != ".bash_history"] == [".bashrc"]
    assert (home / ".bashrc").read_text() == "alias mine=true\n"
