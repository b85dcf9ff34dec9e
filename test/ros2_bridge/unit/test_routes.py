"""The bridge's list of topics."""

import pytest

from ros2_bridge.ros.ros1_side import LIST, load
from ros2_bridge.routes import ECHO_S, Echoes, read_routes
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

OURS = REPOSITORY / "common/ros2_bridge/config/bridge.yaml"


@claim("Our list of topics keeps only the newest velocity, and counts without another")
def test_our_list_keeps_only_the_newest_velocity_and_no_old_one():
    routes = {route.topic: route for route in read_routes(OURS.read_text())}
    velocity = routes["/cmd_vel"]
    assert (velocity.depth, velocity.to_ros1, velocity.to_ros2) == (1, True, False)
    assert 0 < velocity.longest_s <= 0.6 and 0 < routes["/joy"].longest_s <= 0.6
    assert routes["/odom"].depth == 100  # the default


@claim("Our list of topics ...", because="without another list")
@pytest.mark.parametrize("given", [{}, {"topics": ""}, {"topics": str(OURS)}], ids=str)
def test_our_list_counts_without_another(given, tmp_path):
    assert load(tmp_path, given) == read_routes(OURS.read_text())
    assert (tmp_path / LIST).read_text() == OURS.read_text()


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("[", "no YAML"),
        ("topics: [/joy]", "a map with topics"),
        ("topics: {joy: {direction: both}}", "'joy': a topic is written as /name"),
        ("topics: {/joy: both}", "/joy: a map such as"),
        ("topics: {/joy: {depth: 3}}", "/joy: direction is missing"),
        ("topics: {/joy: {direction: up}}", "/joy: direction: 'up' is none of"),
        ("topics: {/joy: {direction: both, deep: 1}}", "/joy: deep is not known"),
        ("topics: {/joy: {direction: both, depth: 0}}", "/joy: depth: 0; allowed is 1 to 10000"),
        ("topics: {/joy: {direction: both, longest_s: .nan}}", "/joy: longest_s: nan"),
        ("topics: {/joy: {direction: both, reliability: 3}}", "/joy: reliability: 3 is none of"),
    ],
)
def test_a_wrong_list_is_one_line(text, why):
    with pytest.raises(ValueError) as error:
        read_routes(text)
    assert str(error.value).startswith(why) and "\n" not in str(error.value)


def test_what_comes_back_counts_once_and_is_expected_for_a_while():
    echoes = Echoes()
    assert max(echoes.expect("/chatter", b"", i * 0.1) for i in range(1000)) == ECHO_S * 10 + 1
    echoes.expect("/chatter", b"hello", 100.0)
    assert [echoes.take("/chatter", b"hello", 101.0) for _ in range(2)] == [True, False]
    assert not echoes.take("/other", b"", 101.0) and not echoes.take("/chatter", b"", 120.0)
