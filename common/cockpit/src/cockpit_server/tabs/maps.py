"""The map."""

from __future__ import annotations

import base64
from math import atan2, isfinite
from typing import Any, Sequence

import numpy as np
from nav_msgs.msg import OccupancyGrid

from cockpit_server.graph import GraphWatcher
from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded
from cockpit_server.pages import Page, TabSource

TOPIC = "/map"
MOST_CELLS = 250_000  # in a page's map; a larger map gets larger cells
LARGEST_MAP = 20_000_000  # bytes


class Maps(TabSource):
    """The map for pages that show the floor."""

    def __init__(self, subscriptions: Subscriptions, graphs: GraphWatcher) -> None:
        self._subscriptions, self._graphs = subscriptions, graphs
        self._map: dict[str, Any] = {}

    @property
    def frame(self) -> str:
        """The map's frame; "" without a map."""
        return str(self._map.get("frame", ""))

    def collect(self, pages: Sequence[Page], now: float) -> None:
        graph, is_shown = self._graphs.graph, any(page.watch.floor for page in pages)
        is_published = TOPIC in graph.publishers and graph.types.get(TOPIC) == OccupancyGrid._type
        if is_shown and not is_published:
            self._map = {}
        handlers = {TOPIC: self._on_map} if is_shown and is_published else {}
        self._subscriptions.set_subscriptions(self, handlers, every=False)

    def send_to(self, page: Page, now: float) -> None:
        if page.watch.floor and page.take_if_new("map", self._map):
            page.send("map", **self._map)

    def _on_map(self, message: ReceivedMessage) -> None:
        shown = map_shown(message.data)
        if shown and shown != self._map:
            self._map = shown


def map_shown(data: bytes) -> dict[str, Any]:
    """Return the map as pages receive it, from the bytes of an OccupancyGrid; {} if malformed.

    x, y, yaw: its corner [m, rad]; cell: the size of a cell [m]; rows and columns; cells: base64, a
    byte for each cell from the lowest row on: 0 free, 1 occupied, 2 unknown; frame: its frame.
    """
    grid = decoded(OccupancyGrid, data, LARGEST_MAP, as_arrays=True) or OccupancyGrid()
    given, info, corner = np.array(grid.data, np.int8), grid.info, grid.info.origin.position
    yaw = 2.0 * atan2(info.origin.orientation.z, info.origin.orientation.w)
    numbers = (corner.x, corner.y, yaw, info.resolution)
    if not given.size or given.size != info.height * info.width or not all(map(isfinite, numbers)):
        return {}
    cells = np.where(given < 0, 2, given >= 50).astype(np.uint8).reshape(info.height, info.width)
    factor = int(np.ceil(np.sqrt(cells.size / MOST_CELLS)))
    if factor > 1:  # A large cell with an occupied cell in it is occupied.
        padded = np.pad(cells, [(0, -size % factor) for size in cells.shape])
        parts = padded.reshape(padded.shape[0] // factor, factor, -1, factor)
        cells = np.where((parts == 1).any(axis=(1, 3)), 1, parts.max(axis=(1, 3)))
    return {
        "x": corner.x, "y": corner.y, "yaw": yaw, "cell": info.resolution * factor,
        "rows": cells.shape[0], "columns": cells.shape[1],
        "frame": grid.header.frame_id.lstrip("/"),
        "cells": base64.b64encode(cells.astype(np.uint8).tobytes()).decode(),
    }  # fmt: skip
