"""What is around the robots: the map, what the laser of one sees, bumpers that are pressed."""

from __future__ import annotations

import base64
import threading
import time
from math import atan2, isfinite
from typing import Any, Sequence

import numpy as np
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from cockpit_server.clients import Client, Source, encoded
from cockpit_server.feeds import Feeds, Raw, read
from cockpit_server.graph import ODOMETRY, topic_of
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.motion import is_somewhere, motion

MOST_CELLS = 250_000  # in a page's map; a larger map gets larger cells
LARGEST_MAP = 20_000_000  # bytes
MOST_POINTS = 160  # in a page's scan
LONGEST_SCAN = 200_000  # bytes
MOST_FRAMES, LONGEST_FRAMES, LONGEST_NAME = 5_000, 1_000_000, 200  # in all; bytes; characters
DIGITS = 3  # after the point [m]
TRUTH, SCAN, EVENT = "base_pose_ground_truth", "scan", "mobile_base/events/bumper"  # topics
EVENT_TYPE = "kobuki_msgs/BumperEvent"
BUMPERS, BUMPER_BYTES = 3, 2  # bytes of an event: which bumper, and whether it is pressed


class Surroundings(Source):
    """The map for pages that show robots, and of the robot they look at what its laser sees."""

    def __init__(self, feeds: Feeds, graph_watch: GraphWatch) -> None:
        self._feeds, self._graphs = feeds, graph_watch
        self._map: dict[str, Any] = {}
        self._text = ""  # the places of all robots, as pages get them
        # topic -> (when it came [s], the newest LaserScan, or Odometry in the frame of the map)
        self._newest: dict[str, tuple[float, bytes]] = {}
        # frame -> x, y [m] on the robot, the newest last
        self._mounts: dict[str, tuple[float, float]] = {}
        self._lock = threading.Lock()  # each publisher of /tf_static has a thread
        self._pressed: dict[str, set[int]] = {}  # topic -> numbers of bumpers

    def collect(self, clients: Sequence[Client], now: float) -> None:
        graph, looks = self._graphs.graph, {c.watch.look for c in clients if c.watch.robots}
        robots = graph.robots() if looks else set()

        def there(wanted: dict[str, tuple[str, Any]]) -> dict[str, Any]:
            types = {t: graph.types.get(t) for t in graph.published} if looks else {}
            return {t: hear for t, (kind, hear) in wanted.items() if types.get(t) == kind}

        newest = there({
            "/map": (OccupancyGrid._type, self._hear_map),
            "/tf_static": (TFMessage._type, self._hear_frames),
            **{topic_of(robot, TRUTH): (ODOMETRY, self._keep) for robot in robots},
            **{topic_of(robot, SCAN): (LaserScan._type, self._keep) for robot in looks & robots},
        })  # fmt: skip
        events = {topic_of(robot, EVENT): (EVENT_TYPE, self._hear_bumper) for robot in robots}
        if looks and "/map" not in newest:
            self._map = {}
        self._feeds.set_subscriptions((self, "newest"), newest, every=False)
        self._feeds.set_subscriptions((self, "events"), there(events), every=True)
        around = {robot: self._around(robot) for robot in sorted(robots)} if self._map else {}
        self._text = encoded("around", robots=around)

    def send_to(self, client: Client, now: float) -> None:
        if client.watch.robots and client.take_if_new("map", self._map):
            client.send("map", **self._map)
        if not client.watch.robots or not self._map:
            return
        if client.take_if_new("around", self._text):
            client.write(self._text)
        robot = client.watch.look
        came, data = self._newest.get(topic_of(robot or "", SCAN), (0.0, b""))
        if robot is not None and data and client.take_if_new("scan", (robot, came)):
            points = scan_points(data, self._mounts)
            if client.take_if_new("points", (robot, points, self._text)):  # none while all stand
                client.send("scan", robot=robot, points=points)

    def _around(self, robot: str) -> dict[str, Any]:
        found: dict[str, Any] = {"bumpers": sorted(self._pressed.get(topic_of(robot, EVENT), ()))}
        truth = read(Odometry, self._newest.get(topic_of(robot, TRUTH), (0.0, b""))[1])
        if truth and is_somewhere(motion(truth)):
            x, y, yaw, _, _ = motion(truth)
            found.update(x=round(x, DIGITS), y=round(y, DIGITS), yaw=round(yaw, 4))
        return found

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

    def _keep(self, message: Raw, topic: str) -> None:
        self._newest[topic] = (time.monotonic(), message.data)

    def _hear_bumper(self, message: Raw, topic: str) -> None:
        if len(message.data) == BUMPER_BYTES and message.data[0] < BUMPERS:
            pressed = self._pressed.setdefault(topic, set())
            (pressed.add if message.data[1] else pressed.discard)(message.data[0])


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
    points: list[list[float]] = ends[:: len(ends) // MOST_POINTS + 1].round(DIGITS).tolist()
    return points
