"""The node, with rospy's threads, and tornado's loop in the main thread."""

from __future__ import annotations

import asyncio
import socket
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Callable

import rospkg
import rospy
from tornado.ioloop import PeriodicCallback

from cockpit_server.access import Access
from cockpit_server.driving.joy2twist_reports import Joy2TwistReports
from cockpit_server.driving.who_drives import Driving
from cockpit_server.hub import TICK_S, Hub
from cockpit_server.io.web_server import server
from cockpit_server.pages import Page
from cockpit_server.ros.feeds import Feeds
from cockpit_server.ros.graph_watch import GraphWatch
from cockpit_server.ros.joysticks import Joysticks
from cockpit_server.ros.tabs.bags import Bags
from cockpit_server.ros.tabs.doctor import Doctor
from cockpit_server.ros.tabs.forms import Forms
from cockpit_server.ros.tabs.outlets import Outlets
from cockpit_server.ros.tabs.plots import Plots
from cockpit_server.ros.tabs.recorder import Recorder
from cockpit_server.ros.tabs.turtles import Turtles
from cockpit_server.ros.transforms import Transforms
from cockpit_server.tabs.diagnostics import Diagnostics
from cockpit_server.tabs.frames import Frames
from cockpit_server.tabs.logs import Logs
from cockpit_server.tabs.maps import Maps
from cockpit_server.tabs.overlays import Overlays
from cockpit_server.tabs.publishing import Publishing
from cockpit_server.tabs.robots import Robots
from cockpit_server.tabs.topics import Topics
from node_kit.ros.log import Log

# How long the end may wait for the last message, and then for its delivery [s].
LONGEST_END_S, DELIVERY_S = 0.3, 0.1
# How long a thread of rospy may block the others [s]: an input must not wait for it.
SWITCH_S = 0.0005


class Cockpit:
    """The node that shows the robots of a master to browsers, and lets one page drive.

    Subscribes: what pages show: odom (nav_msgs/Odometry), joy (sensor_msgs/Joy), scan
        (sensor_msgs/LaserScan), paths (nav_msgs/Path), markers (visualization_msgs/Marker,
        MarkerArray), base_pose_ground_truth (nav_msgs/Odometry) and
        mobile_base/events/bumper, sensors/core, commands/led1, led2, sound (kobuki_msgs), any
        topic;
        /map (nav_msgs/OccupancyGrid), /tf, /tf_static (tf2_msgs/TFMessage),
        /diagnostics, /diagnostics_agg (diagnostic_msgs/DiagnosticArray),
        /rosout (rosgraph_msgs/Log)
    Publishes: joy (sensor_msgs/Joy) of a robot that is driven; what a driver writes into a
        form; topics of a recording that a driver plays
    Calls: services that end in /reset; what a driver writes into a form
    """

    def __init__(self, sockets: list[socket.socket], access: Access) -> None:
        self._sockets = sockets
        name = rospy.get_name()
        graphs = self._graphs = GraphWatch(name)
        log = Log()
        feeds = Feeds(log.warn)
        transforms = Transforms(feeds, graphs)
        frames = Frames(transforms, graphs, rospy.get_time)
        transforms.listeners = (frames,)
        pages: dict[int, Page] = {}
        robots, reports = Robots(feeds, graphs), Joy2TwistReports(feeds)
        joysticks, maps = Joysticks(feeds, graphs, name), Maps(feeds, graphs)
        drawer = ThreadPoolExecutor(1, thread_name_prefix="overlays")
        driving = self._driving = Driving(pages, graphs, joysticks, reports, robots.moves)
        sources = (
            robots, joysticks, driving, graphs, Topics(feeds, graphs), Plots(feeds, graphs),
            Forms(driving, self._soon, graphs), Publishing(driving, graphs, Outlets(graphs)),
            Logs(feeds), Doctor(), Bags(driving, self._soon, graphs), Recorder(), maps,
            Overlays(feeds, graphs, transforms, robots, maps, drawer.submit), Turtles(graphs),
            frames, Diagnostics(feeds),
        )  # fmt: skip
        self._hub = Hub(pages, driving, sources, log.warn, time)
        page = Path(rospkg.RosPack().get_path("cockpit"), "page")
        self._server = server(self._hub, access, page)
        self.has_lost_master = False
        self._has_ended = threading.Event()

    def run(self) -> None:
        sys.setswitchinterval(SWITCH_S)
        asyncio.run(self._serve())

    async def _serve(self) -> None:
        self._loop, self._ended = asyncio.get_running_loop(), asyncio.Event()
        self._graphs.start(self._lose_master)
        self._server.add_sockets(self._sockets)
        ticks = PeriodicCallback(self._hub.tick, 1000 * TICK_S)
        ticks.start()
        rospy.on_shutdown(self._end)
        await self._ended.wait()
        ticks.stop()

    def _lose_master(self) -> None:
        self.has_lost_master = True
        rospy.signal_shutdown("the master has gone")

    def _soon(self, action: Callable[[], object]) -> None:
        self._loop.call_soon_threadsafe(action)

    def _end(self) -> None:
        """Stop the robot; rospy's other threads wait for this."""
        self._soon(self._rest)
        if self._has_ended.wait(LONGEST_END_S):
            threading.Event().wait(DELIVERY_S)
        self._soon(self._ended.set)

    def _rest(self) -> None:
        self._driving.session.end()
        self._has_ended.set()
