"""The commands of the README and its pages run, section by section, in order.

A section's ```bash blocks are its commands. A command that runs until Ctrl-C is ended with its
section, or before another one that drives. A block that opens a student's shell runs in a new
workspace.
"""

import re

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY
from tutorial_testing.waiting import wait_for

README = REPOSITORY / "README.md"
PAGES = [README, *sorted((REPOSITORY / "common/doc").glob("*.md"))]
# Commands that run until Ctrl-C, and what they print once they run ("": nothing).
LASTING = {
    "rosrun beginner_tutorials talker.py": "hello world",
    "roslaunch beginner_tutorials talker_listener.launch": "I heard hello world",
    "rosrun beginner_tutorials": "",
    "rosrun joy2twist joy2twist.py": "axis 1 -> linear.x",
    "rosrun joy2twist": "Get from Joy",
    "roslaunch cockpit cockpit.launch": "http://127.0.0.1",
    "roslaunch --ros-args": None,
    "roslaunch": "process[",
    "rosbag play": "",
    "rosrun rviz rviz": "",
    "rostopic hz": "average rate",
    "rostopic echo /": "---",
}
# Of each line, one command runs at a time: the others are ended before it starts.
EITHER = (
    ("rosrun joy2twist", "roslaunch joy2twist"),
    ("roslaunch fake_turtlebot_sim", "roslaunch joy2twist"),
    ("rosrun beginner_tutorials stop", "rosrun beginner_tutorials wander"),
)
# What does not run here, and why.
LEFT_OUT = {
    "roscore": "runs already: this test has one for every section",
    "./tutorial demo": "test_demo.py and test/check_bare_machine run it",
    "./tutorial test": "is what runs this",
    "./tutorial check --all": "test/tutorial_check/exercises/test_awkward.py checks a class",
    "./tutorial doctor": "test/tutorial_tools/ros asks it, where something moves",
    "roslaunch joy2twist launch_joy_node.launch virtual:=true": "needs the keys of a terminal",
    "roslaunch joy2twist student.launch name:=robot_7 virtual:=true": "as the line before",
    "docker ": "needs an engine; test/check_bare_machine bookworm:image builds the Dockerfile",
}
ELSEWHERE = {
    "Two machines": "test_two_hosts.py runs it on two hosts",
    "rosbridge": "test_rosbridge.py runs it on packages of ours",
    "Start the bridge": "test/foxglove_bridge",
    **dict.fromkeys(("From here to ROS 2", "Both side by side", "With colcon"), "test/ros2_bridge"),
}
STUDENTS_SHELL = "./tutorial shell --in ~/catkin_ws"


def sections():
    """Yield the blocks of every section with commands; a block is a list of lines."""
    for page in PAGES:
        for part in re.split(r"^#+ ", page.read_text(), flags=re.MULTILINE)[1:]:
            heading, _, body = part.partition("\n")
            blocks = []
            for block in re.findall(r"^```bash\n(.*?)^```", body, re.MULTILINE | re.DOTALL):
                lines = [re.sub(r"\s+# .*", "", line).strip() for line in block.splitlines()]
                wanted = [ln for ln in lines if ln and not ln.startswith(tuple(LEFT_OUT))]
                blocks += [wanted] if wanted else []
            if blocks and heading not in ELSEWHERE:
                yield pytest.param(blocks, id=heading)


@pytest.fixture
def roscore(tutorial, host, master_uri):
    """A ROS master, which the README's user starts once and leaves running."""
    with host.start(tutorial, "run", "roscore", "-p", master_uri.rsplit(":", 1)[1]) as program:
        wait_for(lambda: "started core service" in program.output, "roscore")
        yield


@claim("The commands of README and pages run, section by section")
@pytest.mark.long
@pytest.mark.parametrize("blocks", sections())
@pytest.mark.usefixtures("roscore")
def test_the_commands_of_a_section_run(blocks, tutorial, host, suite_workspace, screen, tmp_path):
    environment = {"LIBGL_ALWAYS_SOFTWARE": "1", "HOME": str(tmp_path)}
    environment["TUTORIAL_WORKSPACE"] = suite_workspace  # whatever HOME is
    lasting = {}

    def run(script, *options):
        """Start a script in a new user's home; only RViz gets a screen: it costs a processor."""
        display, script = screen if "rviz" in script else "", f"cd '{tmp_path}' && {script}"
        command = ("run", *options, "bash", "-ec", script)
        return host.start(tutorial, *command, DISPLAY=display, **environment)

    def run_to_its_end(script, *options):
        with run(script, *options) as program:
            assert program.wait() == 0, f"{script}\n{program.output}"

    def end(command):
        with lasting.pop(command) as program:
            program.interrupt()
            program.wait()

    try:
        for block in blocks:
            if block[0] == STUDENTS_SHELL:
                run_to_its_end("\n".join(block[1:]), "--in", f"{tmp_path}/catkin_ws")
                continue
            for command in block:
                signs = [LASTING[start] for start in LASTING if command.startswith(start)]
                sign = signs[0] if signs else None
                if sign is None:
                    run_to_its_end(command)
                    continue
                rivals = sum((line for line in EITHER if command.startswith(line)), ())
                for other in [name for name in lasting if rivals and name.startswith(rivals)]:
                    end(other)
                program = lasting[command] = run(f"exec {command}")
                what = f"{sign} of {command}"
                wait_for(lambda: sign in program.output or program.ended, what)  # noqa: B023
                assert not program.ended, f"{command}\n{program.output}"
    finally:
        for command in list(lasting):
            end(command)
