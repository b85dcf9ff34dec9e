"""The parameters of foxglove_bridge for ROS 1, and its launch file."""

import re
from xml.etree import ElementTree

import pytest
import yaml

from foxglove_bridge_server.parameters import BridgeParameters, is_allowed, parse_parameters
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

pytestmark = claim("The bridge's parameters are upstream's, and limit what clients see and do")
LAUNCH = REPOSITORY / "common/stand_ins/foxglove_bridge/launch/foxglove_bridge.launch"


def launched(**given):
    """Return the parameters that the launch file sets."""
    root = ElementTree.parse(LAUNCH).getroot()
    values = {arg.get("name"): given.get(arg.get("name"), arg.get("default")) for arg in root}
    text = root.find("node/rosparam").text
    return yaml.safe_load(re.sub(r"\$\(arg (\w+)\)", lambda name: values[name[1]], text))


def test_the_launch_file_has_the_defaults_and_passes_each_argument():
    assert parse_parameters(launched()) == BridgeParameters()
    assert BridgeParameters().address == "127.0.0.1"
    given = {"topic_whitelist": r"['/a\d', '/b']", "port": "1", "tls": "true"}
    parameters = parse_parameters(launched(**given))
    assert parameters.topic_whitelist == (r"/a\d", "/b")
    assert (parameters.port, parameters.tls) == (1, True)


def test_a_line_names_what_has_no_effect():
    assert not BridgeParameters().ignored()
    given = {"num_threads": 4, "port": 1, "nodelet_manager": "other"}
    wanted = ["num_threads: 4 has no effect here", "nodelet_manager: other has no effect here"]
    assert parse_parameters(given).ignored() == wanted


@pytest.mark.parametrize(("given", "part"), [
    ({"port": -1}, "~port: -1: must be a port"),
    ({"address": "a b"}, "~address: 'a b': must be an address"),
    ({"topic_whitelist": "/a"}, "must be a list of regular expressions"),
    ({"topic_whitelist": ["/a", "("]}, "'(' is not a regular expression: missing )"),
    ({"topic_whitelist": [1]}, "must be a list of regular expressions"),
    ({"capabilities": ["services", "x"]}, "must be a list of some of clientPublish"),
    ({"max_update_ms": 0}, "must be from 100 to 3600000"),
    ({"whitelist": []}, "no such parameter"),
])  # fmt: skip
def test_a_mistake_is_one_line(given, part):
    with pytest.raises(ValueError, match=r"^~\w+: ") as error:
        parse_parameters(given)
    assert part in str(error.value)
    assert "\n" not in str(error.value)


def test_a_whitelist_matches_whole_names():
    patterns = parse_parameters({"topic_whitelist": ["/a", "/b/.*"]}).topic_whitelist
    names = {"/a": True, "/b/c": True, "/ab": False, "/x/a": False, "/b": False}
    assert {name: is_allowed(name, patterns) for name in names} == names


def test_files_that_clients_may_read_are_models_and_images_of_packages():
    patterns = BridgeParameters().asset_uri_allowlist
    assert is_allowed("package://robot_description/meshes/wheel-2.dae", patterns)
    for uri in ("package://a/../b.dae", "file:///etc/passwd", "package://a/id_rsa", "/a.dae"):
        assert not is_allowed(uri, patterns), uri
