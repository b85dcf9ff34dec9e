"""draw_graph.py: from what the master says to the text that graphviz draws."""

import json
import re
import shutil
import subprocess

import pytest

from tutorial_tools.graph.program import dot_text, shows_a_node

ROSOUT = ["/rosout", ["/talker", "/listener"]]
AGGREGATED = ["/rosout_agg", ["/rosout"]]
TALK = (
    [ROSOUT, AGGREGATED, ["/chatter", ["/talker"]], ["/unheard", ["/talker"]]],
    [["/rosout", ["/rosout"]], ["/chatter", ["/listener"]], ["/unsaid", ["/listener"]]],
    [["/talker/get_loggers", ["/talker"]], ["/add_two_ints", ["/server"]]],
)


def line(text, name):
    """The line that declares a node or a topic, without its indent; "" if none does."""
    found = [part for part in text.splitlines() if part.strip().startswith(f'"{name}" [')]
    assert len(found) <= 1
    return "".join(found).strip()


def frames(text):
    """{machine: lines inside its frame}."""
    parts = text.split("  subgraph ")[1:]
    return {
        part.split('"cluster ')[1].split('"')[0]: part.split("\n  }\n")[0].splitlines()[2:]
        for part in parts
    }


def test_talker_and_listener():
    text = dot_text(TALK, {})
    assert line(text, "node /talker") == '"node /talker" [label="/talker" shape=ellipse]'
    assert line(text, "topic /chatter") == '"topic /chatter" [label="/chatter" shape=box]'
    arrows = [part.strip() for part in text.splitlines() if "->" in part]
    assert arrows == [
        '"node /talker" -> "topic /chatter"',
        '"topic /chatter" -> "node /listener"',
    ]


@pytest.mark.parametrize(
    "hidden",
    ["node /rosout", "topic /rosout", "topic /rosout_agg", "topic /unheard", "topic /unsaid"],
)
def test_what_only_everything_shows(hidden):
    assert hidden not in dot_text(TALK, {})
    assert line(dot_text(TALK, {}, everything=True), hidden)


@pytest.mark.parametrize("everything", [False, True])
def test_services_are_no_topics(everything):
    text = dot_text(TALK, {}, everything)
    assert "get_loggers" not in text
    assert "/server" not in text


def test_a_node_without_a_topic_is_there():
    text = dot_text(([ROSOUT], [["/rosout", ["/rosout"]]], []), {})
    assert line(text, "node /talker")
    assert "->" not in text


def test_a_node_and_a_topic_of_one_name_are_two():
    text = dot_text(([["/odom", ["/odom"]]], [["/odom", ["/odom"]]], []), {})
    assert line(text, "node /odom") and line(text, "topic /odom")
    assert '"node /odom" -> "topic /odom"' in text
    assert '"topic /odom" -> "node /odom"' in text


@pytest.mark.parametrize(
    ("name", "label"),
    [
        ("/mobile_base/commands/velocity", r"/mobile_base\n/commands\n/velocity"),
        ("/cmd_vel_mux/input/teleop", r"/cmd_vel_mux\n/input/teleop"),
        ("/listener_4711_1700000000000", r"/listener_4711\n_1700000000000"),
        ("/myjoystick2twist", "/myjoystick2twist"),  # nowhere to break
        ("/robot_1/odom", "/robot_1/odom"),
    ],
)
def test_a_long_name_is_broken(name, label):
    text = dot_text(([[name, ["/a"]]], [[name, ["/b"]]], []), {})
    assert line(text, f"topic {name}") == f'"topic {name}" [label="{label}" shape=box]'


def test_names_are_in_alphabetical_order():
    names = [f"/{letter}" for letter in "hgfedcba"]
    part = [[topic, names] for topic in names]
    machines = {name: "two" if name > "/d" else "one" for name in names}
    text = dot_text((part, part, []), machines)
    assert list(frames(text)) == ["one", "two"]
    for pattern in (
        r'^ *"node (\S+)" \[',
        r'^ *"topic (\S+)" \[',
        r'^ *"node (\S+)" -> "topic /a"',
        r'^ *"topic /a" -> "node (\S+)"',
    ):
        assert re.findall(pattern, text, re.MULTILINE) == names[::-1], pattern


def test_each_machine_has_its_frame_and_the_topic_between_them_none():
    text = dot_text(TALK, {"/talker": "10.0.0.1", "/listener": "10.0.0.2"})
    assert sorted(frames(text)) == ["10.0.0.1", "10.0.0.2"]
    assert "/talker" in frames(text)["10.0.0.1"][0]
    assert "/listener" in frames(text)["10.0.0.2"][0]
    assert line(text, "topic /chatter")
    assert "topic /chatter" not in str(frames(text))


def test_a_topic_of_one_machine_is_in_its_frame():
    publishers = [["/joy", ["/joy_node"]], ["/cmd_vel", ["/joy2twist"]]]
    subscribers = [["/joy", ["/joy2twist"]], ["/cmd_vel", ["/robot"]]]
    machines = {"/joy_node": "desk", "/joy2twist": "desk", "/robot": "robot"}
    text = dot_text((publishers, subscribers, []), machines)
    assert "topic /joy" in str(frames(text)["desk"])
    assert "topic /cmd_vel" not in str(frames(text))


def test_one_machine_has_no_frame():
    # /rosout, which is not shown, does not count.
    machines = {"/talker": "here", "/listener": "here", "/rosout": "there"}
    assert not frames(dot_text(TALK, machines))
    assert sorted(frames(dot_text(TALK, machines, everything=True))) == ["here", "there"]


def test_a_node_that_has_just_ended_is_on_no_machine():
    text = dot_text(TALK, {"/talker": "here"})
    assert line(text, "node /listener")
    assert not frames(text)


@pytest.mark.skipif(not shutil.which("dot"), reason="graphviz missing: ./tutorial setup")
def test_graphviz_reads_back_every_name():
    names = ['/"quoted"', "/a->b;", "/{graph}", "/größe", "/<b>", "node", "/a b", "/", ""]
    state = ([[name, ["/a"]] for name in names], [[name, ["/b"]] for name in names], [])
    text = dot_text(state, {"/a": 'desk "1"', "/b": "{robot}"})
    done = subprocess.run(
        ["dot", "-Tjson"], input=text, capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stderr == ""
    graph = json.loads(done.stdout)
    said = {part["name"] for part in graph["objects"]}
    clusters = {'cluster desk "1"', "cluster {robot}"}
    assert said == {f"topic {name}" for name in names} | {"node /a", "node /b"} | clusters
    assert len(graph["edges"]) == 2 * len(names)


def test_a_graph_without_a_node_shows_nothing():
    idle = ([[*ROSOUT[:1], ["/rosout"]], AGGREGATED], [["/rosout", ["/rosout"]]], [])
    assert not shows_a_node(dot_text(idle, {"/rosout": "here"}))
    assert shows_a_node(dot_text(idle, {}, everything=True))
    assert not shows_a_node(dot_text(([], [], []), {}, everything=True))
    assert shows_a_node(dot_text(TALK, {"/talker": "here", "/listener": "there"}))
