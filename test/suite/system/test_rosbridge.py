"""OTHER_PROGRAMS.md, rosbridge: the page's lines, with packages of the same needs in our words.

They are those of rosbridge/, in a repository that Git takes for the page's address.
"""

import asyncio
import re
import shutil
import subprocess

import pytest
from tornado.websocket import websocket_connect

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY, Program, free_port
from tutorial_testing.waiting import wait_for

PAGE = (REPOSITORY / "common/doc/OTHER_PROGRAMS.md").read_text(encoding="utf-8")
SECTION = PAGE.split("## rosbridge\n")[1]
LINES = re.search(r"```bash\n(.*?)```", SECTION, re.DOTALL).group(1).splitlines()
START = re.search(r"`(roslaunch rosbridge_server.*?)`", SECTION).group(1)


@pytest.fixture
def run(tmp_path, tutorial, master_uri, monkeypatch):
    """A function that starts a line in the workspace, beside a repository with the packages."""
    upstream, workspace = tmp_path / "upstream", tmp_path / "catkin_ws"
    shutil.copytree(REPOSITORY / "test/suite/system/rosbridge", upstream)
    git = ("git", "-c", "user.name=nobody", "-c", "user.email=nobody@example.org")
    for words in (("init", "-q", "-b", "ros1"), ("add", "."), ("commit", "-qm", "packages")):
        subprocess.run([*git, *words], cwd=upstream, check=True)
    address = next(word for word in LINES[0].split() if word.startswith("https:"))
    monkeypatch.setenv("GIT_CONFIG_COUNT", "1")
    monkeypatch.setenv("GIT_CONFIG_KEY_0", f"url.file://{upstream}.insteadOf")
    monkeypatch.setenv("GIT_CONFIG_VALUE_0", address)
    (workspace / "src").mkdir(parents=True)

    def start(line):
        script = f"cd '{workspace}'; {line}"
        return Program(tutorial, "run", "--in", str(workspace), "bash", "-ec", script)

    return start


@claim("OTHER_PROGRAMS.md: a package that needs rosauth runs after the page's three lines only")
@pytest.mark.long
def test_the_three_lines_make_it_run(run):
    cloned, without_rosauth, made = LINES
    port = free_port()
    start = f"{START} port:={port}"

    def to_its_end(line):
        with run(line) as program:
            return program.wait(), program.output

    def done(*lines):
        for line in lines:
            code, output = to_its_end(line)
            assert code == 0, output

    done(cloned)
    assert "No module named 'rosbridge_server'" in to_its_end(start)[1]
    done(made)
    assert "No module named 'rosauth'" in to_its_end(start)[1]
    done(without_rosauth, made)
    with run(start) as server:
        wait_for(lambda: "server started" in server.output, "server", 60, lambda: server.output)
        asyncio.run(_send(f"ws://127.0.0.1:{port}", "forward"))
        assert 'data: "forward"' in to_its_end("rostopic echo -n 1 from_client")[1]
        assert "count: 1" in to_its_end("rostopic echo -n 1 client_count")[1]


async def _send(address, text):
    client = await websocket_connect(address)
    await client.write_message(text)
    client.close()
