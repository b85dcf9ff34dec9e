"""docker/*.yaml, as far as they can be checked without an engine: the tool itself reads them."""

import re
import subprocess
from pathlib import Path

import pytest
import yaml

from tutorial_testing.two_hosts.scene import ROBOT, WORKSTATION, page_blocks

DOCKER = Path(__file__).resolve().parents[2] / "docker"


def read(name):
    """The services of a compose file, as docker-compose understands it."""
    command = ["docker-compose", "-f", str(DOCKER / name), "config"]
    done = subprocess.run(command, check=False, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return yaml.safe_load(done.stdout)["services"]


@pytest.mark.parametrize("name", ["compose.yaml", "two_hosts.yaml"])
def test_nothing_is_open_to_other_machines(name):
    for service in read(name).values():
        assert service["image"] == "ros1_tutorial"
        assert not {"privileged", "network_mode", "cap_add", "devices"} & set(service)
        assert all(port.startswith("127.0.0.1:") for port in service.get("ports", []))


def test_the_two_hosts_run_the_readme_commands():
    services = read("two_hosts.yaml")
    assert set(services) == {ROBOT, WORKSTATION}
    for host, (_, variables, launch) in page_blocks().items():
        environment = services[host]["environment"]
        assert environment["ROS_MASTER_URI"] == f"http://{ROBOT}:11311"
        assert environment["ROS_HOSTNAME"] == host
        assert re.search(r"ROS_MASTER_URI=http://\S+:11311", variables)
        # In a shell where the line needs one: $$ is a $ of compose's.
        given = services[host]["command"]
        command = given if isinstance(given, str) else " ".join(given)
        command = " ".join(command.replace("$$", "$").replace("'", "").split())
        assert command.endswith(launch)
