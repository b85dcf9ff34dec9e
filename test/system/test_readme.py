"""The README's commands, read from it, run: section by section, in their order.

A section's ```bash blocks are its commands. What lasts until Ctrl-C goes on until the section ends.
"""

import re
import subprocess
from pathlib import Path

import pytest

from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

README = Path(__file__).resolve().parents[2] / "README.md"
# What lasts until Ctrl-C, and what it prints once it runs ("": nothing, being there is enough).
LASTING = {
    "rosrun beginner_tutorials talker.py": "hello world",
    "rosrun beginner_tutorials listener.py": "",
    "roslaunch beginner_tutorials talker_listener.launch": "I heard hello world",
    "rosbag play": "",
    "rostopic hz": "average rate",
    "rostopic echo /": "---",
    "rosrun joy2twist display_joy.py": "Get from Joy",
    "rosrun joy2twist publish_twist.py": "Get from Joy",
    "rosrun joy2twist joy2twist.py": "axis 1 -> linear.x",
    "roslaunch fake_turtlebot_sim minimal.launch": "process[mobile_base",
    "roslaunch fake_turtlebot_sim": "process[fake_turtlebot",
    "roslaunch joy2twist student.launch": "process[robot_7/my",
    "roslaunch joy2twist": "process[my",
    "rosrun rviz rviz": "",
}
# What is not run here, and why.
LEFT_OUT = {
    "roscore": "runs already: this test has one for every section",
    "./tutorial demo": "test_tutorial.py and docker/check_bare_machine run it",
    "./tutorial test": "is what runs this",
    "roslaunch joy2twist launch_joy_node.launch virtual:=true": "needs the keys of a terminal",
    "docker ": "needs an engine; docker/check_bare_machine builds the Dockerfile without one",
}
ELSEWHERE = {
    "Two machines": "test_two_hosts.py runs it on two hosts",
    "When nothing moves": "and asks the doctor there, where something moves",
}


def sections():
    """(heading, blocks) of every section with commands; a block is a list of lines."""
    for part in re.split(r"^#+ ", README.read_text(), flags=re.MULTILINE)[1:]:
        heading, _, body = part.partition("\n")
        blocks = []
        for block in re.findall(r"^```bash\n(.*?)^```", body, re.MULTILINE | re.DOTALL):
            lines = [re.sub(r"\s+# .*", "", line).strip() for line in block.splitlines()]
            blocks.append([line for line in lines if line and not line.startswith(tuple(LEFT_OUT))])
        blocks = [block for block in blocks if block]
        if blocks and heading not in ELSEWHERE:
            yield pytest.param(blocks, id=heading)


def sign_of(command):
    """What a lasting command prints; None for one that ends by itself."""
    return next((LASTING[start] for start in LASTING if command.startswith(start)), None)


@pytest.fixture
def roscore(tutorial, master_uri):
    """A ROS master, which the README's user starts once and keeps."""
    with Program(tutorial, "run", "roscore", "-p", master_uri.rsplit(":", 1)[1]) as program:
        wait_for(lambda: "started core service" in program.output, "roscore")
        yield program
        program.interrupt()
        program.wait()


@pytest.mark.parametrize("blocks", sections())
@pytest.mark.usefixtures("roscore")
def test_section(blocks, tutorial, screen, tmp_path):
    environment = {"DISPLAY": screen, "LIBGL_ALWAYS_SOFTWARE": "1", "HOME": str(tmp_path)}
    workspace = subprocess.run(
        [tutorial, "run", "sh", "-c", "dirname $CMAKE_PREFIX_PATH"],
        check=True, capture_output=True, text=True, timeout=60,
    ).stdout.strip()  # fmt: skip
    environment["TUTORIAL_WORKSPACE"] = workspace  # whatever HOME is
    lasting = []

    def run(script):
        """Start a script in the folder and with the home of a new user."""
        script = f"cd '{tmp_path}' && {script}"
        return Program(tutorial, "run", "bash", "-ec", script, **environment)

    try:
        for block in blocks:
            # A block that goes somewhere is one script; other lines may each have a terminal.
            for command in ["\n".join(block)] if "cd " in block[0] else block:
                sign = sign_of(command)
                if sign is None:
                    with run(command) as program:
                        assert program.wait(120) == 0, f"{command}\n{program.output}"
                    continue
                program = run(f"exec {command}")
                lasting.append(program)
                wait_for(lambda: sign in program.output or program.ended, f"{sign} of {command}")  # noqa: B023
                assert not program.ended, f"{command}\n{program.output}"
    finally:
        for program in lasting:
            with program:
                if not program.ended:
                    program.interrupt()
                program.wait()
                assert "Traceback" not in program.output, program.output
