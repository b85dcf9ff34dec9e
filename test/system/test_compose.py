"""docker/*.yaml, as far as they can be checked without an engine; test/containers runs them."""

import subprocess
from pathlib import Path

import pytest
import yaml

DOCKER = Path(__file__).resolve().parents[2] / "docker"


@pytest.mark.parametrize("name", ["compose.yaml", "two_hosts.yaml"])
def test_nothing_is_open_to_other_machines(name):
    command = ["docker-compose", "-f", str(DOCKER / name), "config"]
    done = subprocess.run(command, check=False, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    for service in yaml.safe_load(done.stdout)["services"].values():
        assert service["image"] == "ros1_tutorial"
        assert not {"privileged", "network_mode", "cap_add", "devices"} & set(service)
        assert all(port.startswith("127.0.0.1:") for port in service.get("ports", []))
        assert service["cap_drop"] == ["ALL"]
        assert service["security_opt"] == ["no-new-privileges:true"]
        assert service["pids_limit"] and service["mem_limit"]
