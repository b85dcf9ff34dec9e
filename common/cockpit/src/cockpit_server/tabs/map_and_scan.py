"""The map, and the scan of the robot in sight."""

from __future__ import annotations

import base64
from math import atan2, isfinite
from typing import Any, Sequence

import numpy as np
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from cockpit_server.graph import GraphWatcher, topic_of
from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded
from cockpit_server.pages import Page, TabSource

MOST_CELLS = 250_000  # in a page's map; a larger map gets larger cells
LARGEST_MAP = 20_000_000  # bytes
MOST_POINTS = 160  # in a page's scan
LONGEST_SCAN = 200_000  # bytes
OLD_S = 2.0  # An older scan is not shown; the slowest scanners publish 5 a second.
MOST_FRAMES, LONGEST_FRAMES, LONGEST_NAME = 5_000, 1_000_000, 200  # in all; bytes; characters
DIGITS = 3  # after the point [m]


class MapAndScan(TabSource):
    """The map for pages that show the floor, and the scan of the robot in sight."""

    def __init__(self, subscriptions: Subscriptions, graphs: GraphWatcher) -> None:
        self._subscriptions, self._graphs = subscriptions, graphs
        self._map: dict[str, Any] = {}
        self._scans: dict[str, tuple[float, bytes]] = {}  # topic -> (arrival [s], newest scan)
        # frame -> x, y [m] on the robot, the newest last
        self._mounts: dict[str, tuple[float, float]] = {}

    def collect(self, pages: Sequence[Page], now: float) -> None:
        graph, looks = self._graphs.graph, {c.watch.look for c in pages if c.watch.floor}
        scans = {topic_of(robot, "scan") for robot in looks & graph.robots()}
        wanted = {
            "/map": (OccupancyGrid._type, self._on_map),
            "/tf_static": (TFMessage._type, self._on_frames),
            **dict.fromkeys(scans, (LaserScan._type, self._on_scan)),
        }
        types = {topic: graph.types.get(topic) for topic in graph.published} if looks else {}
        handlers = {t: handler for t, (kind, handler) in wanted.items() if types.get(t) == kind}
        if looks and "/map" not in handlers:
            self._map = {}
        if looks:
            self._scans = {topic: scan for topic, scan in self._scans.items() if topic in handlers}
        self._subscriptions.set_subscriptions(self, handlers, every=False)

    def send_to(self, page: Page, now: float) -> None:
        if not page.watch.floor:
            return
        if page.take_if_new("map", self._map):
            page.send("map", **self._map)
        robot = page.watch.look
        arrived, data = self._scans.get(topic_of(robot or "", "scan"), (0.0, b""))
        if now - arrived > OLD_S:  # The scanner has exited, or was killed.
            arrived, data = 0.0, b""
        is_needed = robot is not None and (data or "scan" in page.seen)  # also to clear the last
        if is_needed and page.take_if_new("scan", (robot, arrived)):
            points = scan_points(data, self._mounts) if data else []
            page.send("scan", robot=robot, points=points)

    def _on_map(self, message: ReceivedMessage) -> None:
        shown = map_shown(message.data)
        if shown and shown != self._map:
            self._map = shown

    def _on_frames(self, message: ReceivedMessage) -> None:
        frames = decoded(TFMessage, message.data, LONGEST_FRAMES) or TFMessage()
        for stamped in frames.transforms:
            place, frame = stamped.transform.translation, stamped.child_frame_id
            self._mounts.pop(frame, None)
            if len(frame) <= LONGEST_NAME:
                self._mounts[frame] = (place.x, place.y)
            if len(self._mounts) > MOST_FRAMES:
                del self._mounts[next(iter(self._mounts))]

    def _on_scan(self, message: ReceivedMessage) -> None:
        self._scans[message.topic] = (message.arrived, message.data)


def map_shown(data: bytes) -> dict[str, Any]:
    """Return the map as pages receive it, from the bytes of an OccupancyGrid; {} if malformed.

    x, y, yaw: its corner [m, rad]; cell: the size of a cell [m]; rows and columns; cells: base64, a
    byte for each cell from the lowest row on: 0 free, 1 occupied, 2 unknown.
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
        "cells": base64.b64encode(cells.astype(np.uint8).tobytes()).decode(),
    }  # fmt: skip


def scan_points(data: bytes, mounts: dict[str, tuple[float, float]]) -> list[list[float]]:
    """Return the end points of a scan's beams, [[x, y], ...] [m] in the frame of the base.

    mounts: the positions of the scanners' frames on it.
    """
    scan = decoded(LaserScan, data, LONGEST_SCAN, as_arrays=True) or LaserScan()
    x, y = mounts.get(scan.header.frame_id, (0.0, 0.0))
    ranges = np.array(scan.ranges, dtype=float)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    is_seen = np.isfinite(ranges + angles) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
    ranges, angles = ranges[is_seen], angles[is_seen]
    ends = np.stack((x + ranges * np.cos(angles), y + ranges * np.sin(angles)), axis=1)
    return ends[:: len(ends) // MOST_POINTS + 1].round(DIGITS).tolist()
