"""The map, as pages receive it."""

import base64
from math import nan, pi

import pytest
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import String

from cockpit_server.graph import Graph
from cockpit_server.tabs import maps
from tutorial_testing.claims import claim
from tutorial_testing.session_room import Graphs, Topics, look, page, serialised


def grid(rows, columns, data, cell=0.5):
    message = OccupancyGrid()
    message.info.height, message.info.width, message.info.resolution = rows, columns, cell
    message.info.origin.position.x, message.data = -1.0, data
    message.header.frame_id = "/world"
    return message


@claim("Floor: map, scan ...", because="until the world ends")
def test_a_page_is_sent_the_map_when_it_changes():
    types = {"/map": OccupancyGrid._type}
    topics, graphs = Topics(), Graphs(Graph(publishers={"/map": {"/sim"}}, types=types))
    source, room = maps.Maps(topics, graphs), page(floor=True)
    shown = lambda: look(source, room)[0]  # noqa: E731
    assert shown() == [{"kind": "map"}]  # none, as on an empty plane
    topics.hear("/map", grid(1, 3, [0, 100, -1]))
    [message] = shown()
    assert (message["kind"], base64.b64decode(message["cells"])) == ("map", b"\0\1\2")
    assert (shown(), source.frame) == ([], "world")
    graphs.graph = Graph()
    assert (shown(), source.frame) == ([{"kind": "map"}], "")


@pytest.mark.parametrize(
    "message", [String("no map"), grid(2, 2, [0]), grid(0, 0, []), grid(1, 1, [0], cell=nan)]
)
def test_a_malformed_map_is_left_out(message):
    assert maps.map_shown(serialised(message)) == {}


def test_a_map_is_turned_as_its_origin_is():
    turned = grid(1, 1, [0])
    turned.info.origin.orientation.z = turned.info.origin.orientation.w = 0.5**0.5
    assert maps.map_shown(serialised(turned))["yaw"] == pytest.approx(pi / 2)


def test_a_large_map_gets_larger_cells_and_keeps_its_walls():
    data = [0] * (1001 * 1200)
    data[500 * 1200 + 600] = 100
    shown = maps.map_shown(serialised(grid(1001, 1200, data)))
    cells = base64.b64decode(shown["cells"])
    assert len(cells) == shown["rows"] * shown["columns"] <= maps.MOST_CELLS
    factor = shown["cell"] / 0.5
    at = cells.index(1)
    assert (at // shown["columns"], at % shown["columns"]) == (500 // factor, 600 // factor)
    assert cells.count(1) == 1
