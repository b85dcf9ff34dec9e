"""./tutorial setup on a bare system, and where something cannot be installed."""

import re
import shutil

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for
from tutorial_tools.errors import SetUpError
from tutorial_tools.io.command import build

# A system on which nothing is installed yet. LACKING: what its archive lacks; SLOW: download or
# install, which then lasts until the file `go_on` exists; BROKEN: no network and no lists of apt.
FAKES = {
    "dpkg-query": "touch installed; sed 's/^/installed /' installed",
    "apt-cache": r"printf '%s:\n  Candidate: 1\n' ${@:2}",
    "apt-get": """
        trap 'exit 130' INT  # without it bash continues if a sleep ends just then
        echo "$*" >>calls
        last() {
            [ "$SLOW" = "$1" ] || return 0
            touch "slow_$1"
            until [ -e go_on ]; do sleep 0.05; done
        }
        if [ -n "$BROKEN" ]; then echo 'Err:1 no network' ; [[ $* == *" update" ]]; exit; fi
        case $* in
        *" update") ;;
        *--print-uris*) printf "'http://a/b.deb' b.deb %s MD5Sum:0\\n" 200300000 44500000 ;;
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
    "id": "echo 1000",  # not root, so sudo is used, which closes all file descriptors above 2
    "sudo": """
        for number in {3..99}; do eval "exec $number>&-"; done
        exec "$@" """,
}


@pytest.fixture
def bare_system(tmp_path, monkeypatch, own_workspace):
    """A folder with FAKES and their files, which replace Debian's programs on PATH."""
    for name, script in FAKES.items():
        (tmp_path / name).write_text(f"#!/bin/bash\ncd '{tmp_path}'\n{script}\n")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    for name in ("LACKING", "SLOW", "BROKEN"):
        monkeypatch.setenv(name, "")
    return tmp_path


@claim("What the archive lacks is reported once, and done without")
def test_what_the_archive_lacks_is_reported_once_and_done_without(call, bare_system):
    code, first = call("run", "true", LACKING="rviz graphviz")
    line = r"^tutorial: done without, as the archive of .* lacks it: rviz graphviz$"
    assert (code, len(re.findall(line, first, re.MULTILINE))) == (0, 1), first
    assert call("run", "true", LACKING="rviz graphviz") == (0, "")
    assert call("setup", "system")[0] == 0  # checks again
    assert {"rviz", "graphviz"} <= set((bare_system / "installed").read_text().split())


@claim(
    "A clone below a path with spaces works, beside another Python and over a ROS of its own prefix"
)
@pytest.mark.usefixtures("master_uri")
@pytest.mark.night
def test_a_clone_below_a_path_with_spaces_beside_another_python_over_a_ros_in_a_prefix_of_its_own(
    clone, own_workspace, bare_system
):
    prefix = bare_system / "opt/ros/one"
    hooks = prefix / "etc/catkin/profile.d"
    hooks.mkdir(parents=True)
    (prefix / ".catkin").touch()
    (prefix / "setup.bash").write_text(f"export CMAKE_PREFIX_PATH='{prefix}'\n")
    (hooks / "99.made_up.sh").write_text("export ROS_MADE_UP=one\n")
    (bare_system / "python3").write_text("#!/bin/sh\necho 'not the Python of ROS' >&2\nexit 1\n")
    (bare_system / "python3").chmod(0o755)
    for name in ("built", "devel"):
        (own_workspace / name).unlink()
    demo = "rosrun tutorial_tools demo.py --for 3 rviz:=false cockpit:=false"
    script = f"echo $ROS_MADE_UP $CMAKE_PREFIX_PATH; {demo}"
    command = (str(clone / "tutorial"), "run", "sh", "-c", script)
    with Program(*command, TUTORIAL_ROS=str(prefix)) as program:
        assert program.wait(300) == 0, program.output
        assert "not the Python of ROS" not in program.output
        assert re.search(f"^one {own_workspace}/devel:.*:{prefix}$", program.output, re.MULTILINE)
    installed = (bare_system / "installed").read_text().split()
    assert "ros-one-ros-base" in installed and "python3-rospy" not in installed


@claim("Why nothing can be installed is said")
def test_why_nothing_can_be_installed_is_reported(call, bare_system):
    lacking = call("demo", LACKING="rviz python3-rospy")
    assert lacking[0] == 1 and "lacks python3-rospy, without which nothing drives" in lacking[1]
    assert "take Debian 12 or 13" in lacking[1]
    of_noetic = call("demo", LACKING="ros-noetic-ros-base", TUTORIAL_ROS="/opt/ros/noetic")
    assert of_noetic[0] == 1 and "where /opt/ros/noetic comes from; is that still" in of_noetic[1]
    offline = call("demo", BROKEN="yes")
    assert re.search(r"Err:1 no network\n.* not installed: .*Check the network", offline[1])
    assert offline[0] == 1 and not (bare_system / "installed").read_text()


@claim("It installs nothing")
def test_the_doctor_installs_nothing(call, bare_system):
    missing = r"\d\d Debian packages are missing, such as python3-roslaunch"
    line = rf"tutorial: doctor: nothing can drive: {missing}; ./tutorial setup installs them\n"
    code, output = call("doctor")
    assert code == 1 and re.fullmatch(line, output)
    assert not (bare_system / "calls").exists()  # apt-get was not called


@claim(
    "The set-up shows how far it is, by sudo too, and asks again for what an archive out of reach "
    "has"
)
def test_set_up_shows_how_far_it_is_and_asks_again_for_what_an_archive_out_of_reach_has(
    call, bare_system
):
    installed = bare_system / "installed"
    code, output = call("setup", "system")
    assert code == 0, output
    assert "tutorial:    download 50 % of 245 MB\ntutorial:    install 50 %\n" in output
    installed.write_text(installed.read_text().replace("rviz\n", ""))
    code, offline = call("run", "echo", "went on", BROKEN="yes")
    line = "tutorial: done without this time, as apt does not reach all of its archives: rviz."
    assert code == 0 and f"{line} Check the network\nwent on\n" in offline
    assert call("run", "true")[0] == 0
    assert "rviz\n" in installed.read_text()


INTERRUPTED = "tutorial: interrupted; ./tutorial setup goes on where it stopped"


@claim("Ctrl-C ends a download, and waits for dpkg")
def test_ctrl_c_ends_a_download_and_waits_for_dpkg(tutorial, bare_system):
    with Program(tutorial, "demo", SLOW="download") as demo:
        wait_for(lambda: "50 %" in demo.output, "download")
        demo.interrupt()
        assert demo.wait() == 130
        assert demo.output.splitlines()[1:] == ["tutorial:    download 50 % of 245 MB", INTERRUPTED]
        wait_for(lambda: not demo.left_behind(), "end of apt-get")
    with Program(tutorial, "demo", SLOW="install") as demo:
        wait_for((bare_system / "slow_install").exists, "installation")
        demo.interrupt()
        wait_for(lambda: "is finished first, as dpkg must not be cut" in demo.output, "its line")
        (bare_system / "go_on").touch()
        assert demo.wait() == 130
        assert demo.output.splitlines()[-1] == INTERRUPTED
    assert "python3-rospy\n" in (bare_system / "installed").read_text()


@claim("Without PyPI all works but replay_bag, and the lines that check names in C++")
def test_without_pypi_only_replay_bag_is_missing(call, bare_system):
    assert call("setup", "system")[0] == 0
    (bare_system / "ws" / "python").unlink()
    offline = {
        "PIP_INDEX_URL": "http://localhost:9/", "PIP_RETRIES": "0", "PIP_NO_CACHE_DIR": "1",
        "PIP_CONFIG_FILE": "/dev/null", "PIP_EXTRA_INDEX_URL": "", "PIP_FIND_LINKS": "",
    }  # fmt: skip
    code, first = call("run", "echo", "went on", **offline)
    assert code == 0 and "ERROR" not in first  # pip's errors are only in its log
    assert "not installed from PyPI: rosbags vermin" in first.replace("\n", " ")
    without = "replay_bag does not work, and ./tutorial check names no line of C++"
    assert first.endswith(f"tutorial: without it {without}; everything else works\nwent on\n")
    assert call("run", "echo", "went on", **offline) == (0, "went on\n")


@claim("pip installs no file of another hash, and only what a lock has")
def test_pip_installs_no_file_of_another_hash(tmp_path, monkeypatch):
    lock = tmp_path / "test/locks/own.txt"
    lock.parent.mkdir(parents=True)
    (tmp_path / "thing-1.0-py3-none-any.whl").touch()
    (tmp_path / "asked.txt").write_text("thing==1.0")
    monkeypatch.setattr(build, "REPOSITORY", tmp_path)
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path))
    lock.write_text(f"thing==1.0 --hash=sha256:{64 * '0'}\n")
    with pytest.raises(SetUpError, match="not installed from PyPI: thing"):
        build.install_from_pypi(tmp_path / "ws", "own", "asked.txt", "pypi")
    assert "DO NOT MATCH THE HASHES" in (tmp_path / "ws/pip.log").read_text()


@claim("After a failed build nothing counts as built")
def test_after_a_build_that_failed_nothing_counts_as_built(clone, own_workspace, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(clone, copy, symlinks=True)
    (copy / "common" / "node_kit" / "package.xml").write_text("no XML")
    with Program(str(copy / "tutorial"), "setup", "workspace") as setup:
        assert setup.wait() == 1
        assert "tutorial: catkin_make failed" in setup.output
    assert not (own_workspace / "built").exists()
