"""What is around the robots: the map, and what the laser of one sees."""

from __future__ import annotations

import base64
import threading
import time
from math import atan2, isfinite
from typing import Any, Sequence

import numpy as np
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from cockpit_server.clients import Client, Source
from cockpit_server.graph import topic_of
from cockpit_server.ros.feeds import Feeds, Raw, read
from cockpit_server.ros.graph_watch import GraphWatch

MOST_CELLS = 250_000  # in a page's map; a larger map gets larger cells
LARGEST_MAP = 20_000_000  # bytes
MOST_POINTS = 160  # in a page's scan
LONGEST_SCAN = 200_000  # bytes
OLD_S = 2.0  # An older scan is not shown; the slowest scanners have 5 in a second.
MOST_FRAMES, LONGEST_FRAMES, LONGEST_NAME = 5_000, 1_000_000, 200  # in all; bytes; characters
DIGITS = 3  # after the point [m]


class Surroundings(Source):
    """The map for pages that show robots, and of the robot they look at what its laser sees."""

    def __init__(self, feeds: Feeds, graph_watch: GraphWatch) -> None:
        self._feeds, self._graphs = feeds, graph_watch
        self._map: dict[str, Any] = {}
        self._scans: dict[str, tuple[float, bytes]] = {}  # topic -> (when it came [s], the newest)
        # frame -> x, y [m] on the robot, the newest last
        self._mounts: dict[str, tuple[float, float]] = {}
        self._lock = threading.Lock()  # each publisher of /tf_static has a thread

    def collect(self, clients: Sequence[Client], now: float) -> None:
        graph, looks = self._graphs.graph, {c.watch.look for c in clients if c.watch.floor}
        scans = {topic_of(robot, "scan") for robot in looks & graph.robots()}
        wanted = {
            "/map": (OccupancyGrid._type, self._hear_map),
            "/tf_static": (TFMessage._type, self._hear_frames),
            **dict.fromkeys(scans, (LaserScan._type, self._hear_scan)),
        }
        types = {topic: graph.types.get(topic) for topic in graph.published} if looks else {}
        there = {topic: hear for topic, (kind, hear) in wanted.items() if types.get(topic) == kind}
        if looks and "/map" not in there:
            self._map = {}
        if looks:
            self._scans = {topic: scan for topic, scan in self._scans.items() if topic in there}
        self._feeds.set_subscriptions(self, there, every=False)

    def send_to(self, client: Client, now: float) -> None:
        if not client.watch.floor:
            return
        if client.take_if_new("map", self._map):
            client.send("map", **self._map)
        robot = client.watch.look
        came, data = self._scans.get(topic_of(robot or "", "scan"), (0.0, b""))
        if now - came > OLD_S:  # The scanner has ended, or was killed.
            came, data = 0.0, b""
        is_wanted = robot is not None and (data or "scan" in client.seen)  # or it has ended
        if is_wanted and client.take_if_new("scan", (robot, came)):
            points = scan_points(data, self._mounts) if data else []
            client.send("scan", robot=robot, points=points)

    def _hear_map(self, message: Raw, _topic: str) -> None:
        shown = map_shown(message.data)
        if shown and shown != self._map:
            self._map = shown

    def _hear_frames(self, message: Raw, _topic: str) -> None:
        for one in (read(TFMessage, message.data, LONGEST_FRAMES) or TFMessage()).transforms:
            place, frame = one.transform.translation, one.child_frame_id
            with self._lock:
                self._mounts.pop(frame, None)
                if len(frame) <= LONGEST_NAME:
                    self._mounts[frame] = (place.x, place.y)
                if len(self._mounts) > MOST_FRAMES:
                    del self._mounts[next(iter(self._mounts))]

    def _hear_scan(self, message: Raw, topic: str) -> None:
        self._scans[topic] = (time.monotonic(), message.data)


def map_shown(data: bytes) -> dict[str, Any]:
    """Return the map as pages get it, from the bytes of an OccupancyGrid; {} if malformed.

    x, y, yaw: its corner [m, rad]; cell: its size [m]; rows and columns; cells: base64, a byte for
    each from the lowest row on: 0 free, 1 occupied, 2 unknown.
    """
    grid = read(OccupancyGrid, data, LARGEST_MAP, as_arrays=True) or OccupancyGrid()
    given, info, corner = np.array(grid.data, np.int8), grid.info, grid.info.origin.position
    yaw = 2.0 * atan2(info.origin.orientation.z, info.origin.orientation.w)
    numbers = (corner.x, corner.y, yaw, info.resolution)
    if not given.size or given.size != info.height * info.width or not all(map(isfinite, numbers)):
        return {}
    cells = np.where(given < 0, 2, given >= 50).astype(np.uint8).reshape(info.height, info.width)
    factor = int(np.ceil(np.sqrt(cells.size / MOST_CELLS)))
    if factor > 1:  # occupied is what has an occupied cell in it
        padded = np.pad(cells, [(0, -size % factor) for size in cells.shape])
        parts = padded.reshape(padded.shape[0] // factor, factor, -1, factor)
        cells = np.where((parts == 1).any(axis=(1, 3)), 1, parts.max(axis=(1, 3)))
    return {
        "x": corner.x, "y": corner.y, "yaw": yaw, "cell": info.resolution * factor,
        "rows": cells.shape[0], "columns": cells.shape[1],
        "cells": base64.b64encode(cells.astype(np.uint8).tobytes()).decode(),
    }  # fmt: skip


def scan_points(data: bytes, mounts: dict[str, tuple[float, float]]) -> list[list[float]]:
    """Return where a scan's beams end, [[x, y], ...] [m] in the frame of the base.

    mounts: where the frames of the scanners are on it.
    """
    scan = read(LaserScan, data, LONGEST_SCAN, as_arrays=True) or LaserScan()
    x, y = mounts.get(scan.header.frame_id, (0.0, 0.0))
    ranges = np.array(scan.ranges, dtype=float)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    is_seen = np.isfinite(ranges + angles) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
    ranges, angles = ranges[is_seen], angles[is_seen]
    ends = np.stack((x + ranges * np.cos(angles), y + ranges * np.sin(angles)), axis=1)
    return ends[:: len(ends) // MOST_POINTS + 1].round(DIGITS).tolist()
