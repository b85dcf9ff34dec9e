"""What is around the robots: the map, what the laser of one sees, bumpers that are pressed."""

from __future__ import annotations

import base64
import threading
import time
from math import isfinite
from typing import Any, Callable, Sequence

import numpy as np
from genpy import DeserializationError
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from cockpit_server.clients import Client, Source, encoded
from cockpit_server.graph import topic_of
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.motion import is_somewhere, motion

MOST_CELLS = 250_000  # of the map as pages get it; a larger one gets larger cells
LARGEST_MAP = 20_000_000  # bytes
MOST_POINTS = 160  # of a scan as pages get it
LONGEST_SCAN = 200_000  # bytes
DIGITS = 3  # of metres
MAP, TRUTH, SCAN = "nav_msgs/OccupancyGrid", "nav_msgs/Odometry", "sensor_msgs/LaserScan"
BUMPER, BUMPER_BYTES = "kobuki_msgs/BumperEvent", 2  # which one, and whether it is pressed
BUMPERS = 3


class Surroundings(Source):
    """The map for pages that show robots, and of the robot they look at what its laser sees."""

    def __init__(self, feeds: Any, graph_watch: GraphWatch) -> None:
        self._feeds, self._graphs = feeds, graph_watch
        self._map: dict[str, Any] = {}
        self._version, self._text = 0, ""
        self._poses: dict[str, bytes] = {}  # topic -> the newest Odometry in the frame of the map
        self._scans: dict[str, tuple[float, bytes]] = {}  # topic -> (when it came [s], LaserScan)
        self._mounts: dict[str, tuple[float, float]] = {}  # frame -> x, y [m] on the robot
        self._pressed: dict[str, set[int]] = {}  # topic -> numbers of bumpers
        self._lock = threading.Lock()  # of the pressed ones

    def prepare(self, clients: Sequence[Client], now: float) -> None:
        types, watched = self._graphs.graph.types, [one for one in clients if one.watch.robots]
        robots = self._graphs.graph.robots() if watched else set()
        looked_at = {one.watch.look for one in watched} & robots
        newest: dict[str, Callable[[Any, str], None]] = {
            "/map": self._hear_map,
            "/tf_static": self._hear_frames,
        }
        newest.update({topic_of(r, "base_pose_ground_truth"): self._hear_pose for r in robots})
        newest.update({topic_of(robot, "scan"): self._hear_scan for robot in looked_at})
        known = {MAP, TRUTH, SCAN, "tf2_msgs/TFMessage"}
        there = {t: hear for t, hear in newest.items() if watched and types.get(t) in known}
        if "/map" not in there:
            self._map = {}
        self._feeds.want((self, "newest"), there, every=False)
        events = {topic_of(robot, "mobile_base/events/bumper") for robot in robots}
        pressing = {topic: self._hear_bumper for topic in events if types.get(topic) == BUMPER}
        self._feeds.want((self, "events"), pressing, every=True)
        around = {robot: self._around(robot) for robot in sorted(robots)} if self._map else {}
        self._text = encoded("around", robots=around)

    def give(self, client: Client, now: float) -> None:
        if not client.watch.robots or not self._map:
            return
        if client.lacks("map", self._version):
            client.send("map", **self._map)
        if client.lacks("around", self._text):
            client.write(self._text)
        robot = client.watch.look
        if robot is None:
            return
        came, data = self._scans.get(topic_of(robot, "scan"), (0.0, b""))
        if data and client.lacks("scan", (robot, came)):
            client.send("scan", robot=robot, points=scan_points(data, self._mounts))

    def _around(self, robot: str) -> dict[str, Any]:
        pressed = self._pressed.get(topic_of(robot, "mobile_base/events/bumper"), set())
        found: dict[str, Any] = {"bumpers": sorted(pressed)}
        data = self._poses.get(topic_of(robot, "base_pose_ground_truth"))
        place = motion(data) if data else None
        if place and is_somewhere(place):
            found.update(
                x=round(place.x, DIGITS), y=round(place.y, DIGITS), yaw=round(place.yaw, 4)
            )
        return found

    def _hear_map(self, message: Any, _topic: str) -> None:
        shown = map_shown(message.data)
        if shown and shown != self._map:
            self._map = shown
            self._version += 1

    def _hear_frames(self, message: Any, _topic: str) -> None:
        try:
            frames = TFMessage().deserialize(message.data).transforms
        except DeserializationError:
            return
        for one in frames:
            place = one.transform.translation
            self._mounts[one.child_frame_id] = (place.x, place.y)

    def _hear_pose(self, message: Any, topic: str) -> None:
        self._poses[topic] = message.data

    def _hear_scan(self, message: Any, topic: str) -> None:
        self._scans[topic] = (time.monotonic(), message.data)

    def _hear_bumper(self, message: Any, topic: str) -> None:
        if len(message.data) != BUMPER_BYTES or message.data[0] >= BUMPERS:
            return
        with self._lock:
            pressed = set(self._pressed.get(topic, ()))
            (pressed.add if message.data[1] else pressed.discard)(message.data[0])
            self._pressed[topic] = pressed


def map_shown(data: bytes) -> dict[str, Any]:
    """Return the map as pages get it, from the bytes of an OccupancyGrid; {} if it is none.

    x, y: its corner [m]; cell: its size [m]; rows and columns; cells: base64, a byte for each from
    the lowest row on: 0 free, 1 occupied, 2 unknown.
    """
    if len(data) > LARGEST_MAP:
        return {}
    try:
        grid = OccupancyGrid().deserialize(data)
    except DeserializationError:
        return {}
    info = grid.info
    corner, rows, columns = info.origin.position, info.height, info.width
    given = np.array(grid.data, dtype=np.int8)
    numbers = (corner.x, corner.y, info.resolution)
    if not given.size or given.size != rows * columns or not all(map(isfinite, numbers)):
        return {}
    cells = np.where(given < 0, 2, given >= 50).astype(np.uint8).reshape(rows, columns)
    factor = int(np.ceil(np.sqrt(cells.size / MOST_CELLS)))
    if factor > 1:  # occupied is what has an occupied cell in it
        padded = np.pad(cells, [(0, -size % factor) for size in cells.shape])
        parts = padded.reshape(padded.shape[0] // factor, factor, -1, factor)
        cells = np.where((parts == 1).any(axis=(1, 3)), 1, parts.max(axis=(1, 3)))
    return {
        "x": corner.x, "y": corner.y, "cell": info.resolution * factor,
        "rows": cells.shape[0], "columns": cells.shape[1],
        "cells": base64.b64encode(cells.astype(np.uint8).tobytes()).decode(),
    }  # fmt: skip


def scan_points(data: bytes, mounts: dict[str, tuple[float, float]]) -> list[list[float]]:
    """Return where a scan's beams end, [[x, y], ...] [m] in the frame of the base.

    mounts: where the frames of the scanners are on it.
    """
    if len(data) > LONGEST_SCAN:
        return []
    try:
        scan = LaserScan().deserialize(data)
    except DeserializationError:
        return []
    x, y = mounts.get(scan.header.frame_id, (0.0, 0.0))
    ranges = np.array(scan.ranges, dtype=float)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    is_seen = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
    is_seen &= np.isfinite(angles)
    ranges, angles = ranges[is_seen], angles[is_seen]
    step = len(ranges) // MOST_POINTS + 1
    ends = np.stack((x + ranges * np.cos(angles), y + ranges * np.sin(angles)), axis=1)[::step]
    points: list[list[float]] = np.round(ends, DIGITS).tolist()
    return points
