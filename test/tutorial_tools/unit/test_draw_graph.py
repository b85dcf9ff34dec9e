"""draw_graph.py: from the master's answers to the text for graphviz."""

import re
import shutil

import pytest

from tutorial_testing.claims import claim
from tutorial_tools.graph_dot import dot_text
from tutorial_tools.ros import draw_graph

pytestmark = claim("The graph has what talks, frames for machines, any name, four formats")
TALK = (
    [["/rosout", ["/talker", "/listener"]], ["/rosout_agg", ["/rosout"]],
     ["/chatter", ["/talker"]], ["/unheard", ["/talker"]]],
    [["/rosout", ["/rosout"]], ["/chatter", ["/listener"]], ["/unsaid", ["/listener"]]],
    [["/talker/get_loggers", ["/talker"]], ["/add_two_ints", ["/server"]]],
)  # fmt: skip


def names(text):
    return re.findall(r'^ *"(\w+ /\S*)" \[', text, re.MULTILINE)


def test_topics_that_join_nodes_are_drawn_and_the_log_and_loose_ends_on_demand():
    text = dot_text(TALK, {"/talker": "here", "/listener": "here"})
    assert names(text) == ["node /listener", "node /talker", "topic /chatter"]
    assert '"node /talker" [label="/talker" shape=ellipse]' in text
    arrows = [part.strip() for part in text.splitlines() if "->" in part]
    assert arrows == ['"node /talker" -> "topic /chatter"', '"topic /chatter" -> "node /listener"']
    more = {"node /rosout", "topic /rosout", "topic /rosout_agg", "topic /unheard", "topic /unsaid"}
    assert set(names(dot_text(TALK, {}, everything=True))) == {*names(text), *more}


def test_each_machine_has_a_frame_and_a_topic_between_machines_has_none():
    velocity = "/mobile_base/commands/velocity"
    publishers = [["/joy", ["/joy_node"]], [velocity, ["/joy2twist"]]]
    subscribers = [["/joy", ["/joy2twist"]], [velocity, ["/robot"]]]
    machines = {"/robot": "robot", "/joy_node": "desk", "/joy2twist": "desk"}
    text = dot_text((publishers, subscribers, []), machines)
    desk = ["node /joy2twist", "node /joy_node", "topic /joy"]
    frames = re.findall(r'subgraph "cluster (\S+)" {\n(.*?)\n  }\n', text, re.DOTALL)
    shown = [(machine, names(inside)) for machine, inside in frames]
    assert shown == [("desk", desk), ("robot", ["node /robot"])]
    assert rf'  "topic {velocity}" [label="/mobile_base\n/commands\n/velocity" ' in text


@pytest.fixture
def drawn(monkeypatch, tmp_path, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(draw_graph, "ask_master", lambda: (TALK, {}))

    def draw(*arguments):
        try:
            draw_graph.main(list(arguments))
        except SystemExit as end:
            return str(end)
        return capsys.readouterr().out.rstrip()

    return draw


@pytest.mark.skipif(not shutil.which("dot"), reason="graphviz missing: ./tutorial setup")
def test_the_ending_of_the_file_chooses_the_format(drawn, tmp_path):
    assert drawn("a.PDF") == f"draw_graph: wrote {tmp_path}/a.PDF"
    assert (tmp_path / "a.PDF").read_bytes().startswith(b"%PDF-")


@claim("What cannot be drawn is one line, and writes nothing")
def test_what_cannot_be_drawn_is_one_line_and_writes_nothing(drawn, tmp_path, monkeypatch):
    assert drawn("graph.gif") == "draw_graph: graph.gif must end in .png, .svg, .pdf or .dot"
    assert drawn("no/a.dot") == "draw_graph: cannot write no/a.dot: No such file or directory"
    monkeypatch.setenv("PATH", "/nowhere")
    assert "dot is missing: sudo apt install graphviz" in drawn("a.png")
    monkeypatch.setattr(draw_graph, "ask_master", lambda: (([], [], []), {}))
    assert "nothing runs on http" in drawn("a.png")
    monkeypatch.undo()
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:9")  # "discard": no master listens
    assert drawn("a.png").endswith("no ROS master at http://localhost:9; start one with: roscore")
    assert list(tmp_path.iterdir()) == []
