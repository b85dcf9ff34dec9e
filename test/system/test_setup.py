"""./tutorial setup where nothing is installed yet, or something cannot be."""

import re
import shutil

import pytest

from tutorial_testing.processes import Program, refuse
from tutorial_testing.waiting import wait_for

# A system on which nothing is installed yet. LACKING: what its archive has not; SLOW: download or
# install, which then lasts until the file `go_on` is there; BROKEN: no network, nor lists of apt's.
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
    "id": "echo 1000",  # not root, so by sudo, which closes all file descriptors above 2
    "sudo": """
        for number in {3..99}; do eval "exec $number>&-"; done
        exec "$@" """,
}


@pytest.fixture
def bare_system(tmp_path, monkeypatch, own_workspace):
    """A folder for FAKES and their files; programs that start see them instead of Debian's."""
    for name, script in FAKES.items():
        (tmp_path / name).write_text(f"#!/bin/bash\ncd '{tmp_path}'\n{script}\n")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    for name in ("LACKING", "SLOW", "BROKEN"):
        monkeypatch.setenv(name, "")
    return tmp_path


@pytest.mark.usefixtures("bare_system")
def test_set_up_by_sudo_shows_how_far_it_is(tutorial):
    with Program(tutorial, "setup", "system") as setup:
        assert setup.wait() == 0, setup.output
        assert "tutorial:    download 50 % of 245 MB\ntutorial:    install 50 %\n" in setup.output


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


def test_a_ros_in_a_prefix_of_its_own_is_installed_and_built_over(
    tutorial, bare_system, monkeypatch
):
    prefix = bare_system / "opt/ros/one"
    hooks = prefix / "etc/catkin/profile.d"
    hooks.mkdir(parents=True)
    (prefix / ".catkin").touch()
    (prefix / "setup.bash").write_text(f"export CMAKE_PREFIX_PATH='{prefix}'\n")
    (hooks / "99.made_up.sh").write_text("export ROS_MADE_UP=one\n")
    monkeypatch.setenv("TUTORIAL_ROS", str(prefix))
    monkeypatch.setenv("TUTORIAL_WORKSPACE", str(bare_system / "one_ws"))
    with Program(tutorial, "run", "sh", "-c", "echo $ROS_MADE_UP $CMAKE_PREFIX_PATH") as program:
        assert program.wait() == 0, program.output
        assert re.search(f"^one .*/one_ws/devel:.*:{prefix}$", program.output, re.MULTILINE)
    installed = (bare_system / "installed").read_text().split()
    assert "ros-one-ros-base" in installed and "python3-rospy" not in installed


def test_an_archive_without_what_drives_is_named(tutorial, bare_system, monkeypatch):
    monkeypatch.setenv("LACKING", "rviz python3-rospy")
    with Program(tutorial, "demo") as demo:
        assert demo.wait() == 1
        assert "lacks python3-rospy, without which nothing drives" in demo.output
        assert "network" not in demo.output
    assert not (bare_system / "installed").read_text()


def test_the_doctor_installs_nothing(tutorial, bare_system):
    line = refuse(tutorial, "doctor")
    missing = (
        r"doctor: nothing can drive: \d\d Debian packages are missing, such as python3-roslaunch"
    )
    assert re.search(rf"^tutorial: {missing}; \./tutorial setup installs them$", line)
    assert not (bare_system / "calls").exists()  # of apt-get


@pytest.mark.usefixtures("bare_system")
def test_without_a_network_it_says_so(tutorial, monkeypatch):
    monkeypatch.setenv("BROKEN", "yes")
    with Program(tutorial, "demo") as demo:
        assert demo.wait() == 1
        assert re.search(r"Err:1 no network\n.* not installed: .*Check the network", demo.output)


def test_what_an_unreachable_archive_may_have_is_asked_for_again(
    tutorial, bare_system, monkeypatch
):
    installed = bare_system / "installed"
    with Program(tutorial, "setup", "system") as setup:
        assert setup.wait() == 0
    installed.write_text(installed.read_text().replace("rviz\n", ""))
    monkeypatch.setenv("BROKEN", "yes")
    with Program(tutorial, "run", "echo", "went on") as offline:
        assert offline.wait() == 0
        line = "tutorial: done without this time, as apt does not reach all of its archives: rviz."
        assert f"{line} Check the network\nwent on\n" in offline.output
    monkeypatch.setenv("BROKEN", "")
    with Program(tutorial, "run", "true") as online:
        assert online.wait() == 0
    assert "rviz\n" in installed.read_text()


INTERRUPTED = "tutorial: interrupted; ./tutorial setup goes on where it stopped"


def test_ctrl_c_ends_a_download_quietly(tutorial, bare_system, monkeypatch):
    monkeypatch.setenv("SLOW", "download")
    with Program(tutorial, "demo") as demo:
        wait_for((bare_system / "slow_download").exists, "download")
        demo.interrupt()
        assert demo.wait() == 130
        assert demo.output.splitlines()[1:] == ["tutorial:    download 50 % of 245 MB", INTERRUPTED]
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
    """Nothing answers there; it is reported once."""
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


def test_after_a_build_that_failed_nothing_counts_as_built(clone, own_workspace, tmp_path):
    """What is built of another list of packages is removed before."""
    copy = tmp_path / "copy"
    shutil.copytree(clone, copy, symlinks=True)
    (copy / "common" / "node_kit" / "package.xml").write_text("no XML")
    with Program(str(copy / "tutorial"), "setup", "workspace") as setup:
        assert setup.wait() == 1
        assert "tutorial: catkin_make failed" in setup.output
    assert not (own_workspace / "built").exists()


def test_why_a_workspace_is_not_built_is_said_in_catkins_words(tutorial, tmp_path):
    """Those of a workspace of catkin build's, which no word for an error is among."""
    for name in ("src", "build"):
        (tmp_path / name).mkdir()
    (tmp_path / "build" / ".built_by").write_text("catkin build")
    with Program(tutorial, "run", "--in", str(tmp_path), "echo", "went on") as run:
        assert run.wait() == 0
        assert "was previously built by 'catkin build'" in run.output
        assert run.output.endswith("\nwent on\n")
