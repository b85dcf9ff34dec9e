"""The map of a world, with the topics and services of map_server."""

from __future__ import annotations

import io
import threading
from pathlib import Path
from typing import Any, Callable

import rospy
from nav_msgs.msg import MapMetaData, OccupancyGrid
from nav_msgs.srv import GetMap, GetMapResponse, LoadMap, LoadMapResponse

from fake_turtlebot_sim.errors import WorldError
from fake_turtlebot_sim.simulator.world_files import read_grid
from fake_turtlebot_sim.simulator.world_messages import grid_message


class SerialisedMap(GetMapResponse):
    """A response that is serialized already: the map of a large building takes a while."""

    __slots__ = ("data",)

    def serialize(self, buff: Any) -> None:
        """Write the bytes of the OccupancyGrid, the response's only field."""
        buff.write(self.data)


class MapTopics:
    """Publishers, latched: map, map_metadata. Services: static_map, change_map (of nav_msgs).

    change_map replaces the published map, but not the world in which robots drive.
    """

    def __init__(self, grid: OccupancyGrid, warn: Callable[[str], None]) -> None:
        """Publish the grid."""
        self._frame, self._warn, self._lock = grid.header.frame_id, warn, threading.Lock()
        self._map = rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True)
        self._metadata = rospy.Publisher("map_metadata", MapMetaData, queue_size=1, latch=True)
        self._answer = SerialisedMap()
        self._show(grid)
        rospy.Service("static_map", GetMap, lambda _: self._answer)
        rospy.Service("change_map", LoadMap, self._on_change)

    def _show(self, grid: OccupancyGrid) -> None:
        data, answer = io.BytesIO(), SerialisedMap()
        grid.serialize(data)
        answer.data = data.getvalue()
        with self._lock:
            self._answer = answer
            self._metadata.publish(grid.info)
            self._map.publish(rospy.AnyMsg().deserialize(answer.data))

    def _on_change(self, request: Any) -> Any:
        """Publish the map at a path; as with map_server, the response has no map."""
        try:
            grid = read_grid(Path(request.map_url))
        except WorldError as error:
            self._warn(f"change_map: {request.map_url}: {error}")
            return LoadMapResponse(result=LoadMapResponse.RESULT_UNDEFINED_FAILURE)
        self._show(grid_message(grid, self._frame, rospy.Time.now()))
        rospy.loginfo(f"Changed map to {request.map_url}")
        return LoadMapResponse(result=LoadMapResponse.RESULT_SUCCESS)
