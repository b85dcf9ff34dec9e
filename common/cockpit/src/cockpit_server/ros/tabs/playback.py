"""What publishes the recording that plays. Its messages stay bytes."""

from __future__ import annotations

import time
from functools import partial
from typing import Any, Callable, Mapping, Sequence, Union

import rospy
from sensor_msgs.msg import Joy

from cockpit_server.driving.driver_session import DriverSession
from cockpit_server.driving.player import Message
from cockpit_server.graph import JOY, GraphWatcher
from cockpit_server.messages import decoded
from cockpit_server.ros.joysticks import LONGEST_JOY
from cockpit_server.ros.tabs.bag_files import read_messages
from cockpit_server.ros.tabs.recorded_types import Connection
from cockpit_server.tabs.publishing import VELOCITY
from cockpit_server.tabs.recordings import Recording
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

CONNECT_S = 1.0  # how long the first message waits for subscribers
LOOK_S = 0.02
QUEUE = 100  # messages for a subscriber that is behind, as in rqt_bag
ZERO = bytes(48)  # six float64
Send = Callable[[bytes], object]


class Queued(rospy.Publisher):
    """A publisher that drops no message of a burst."""

    end = rospy.Publisher.unregister

    @property
    def listeners(self) -> int:
        return int(self.get_num_connections())


Output = Union[Queued, PromptPublisher]


def output_of(about: Connection) -> Output:
    kind = raw_kind(about)
    if about.type == VELOCITY:  # A velocity is never latched, nor kept for later.
        return PromptPublisher(about.topic, kind)
    return Queued(about.topic, kind, queue_size=QUEUE, latch=about.is_latched)


def raw_kind(about: Connection) -> type[rospy.AnyMsg]:
    """Return a class for a publisher whose messages stay bytes."""
    names = {"_type": about.type, "_md5sum": about.md5sum, "_full_text": about.definition}
    return type("Recorded", (rospy.AnyMsg,), names)


class Playback:
    """The topics that were played last: their messages and publishers. Used by one thread."""

    def __init__(self, graphs: GraphWatcher, session: DriverSession) -> None:
        self._graphs, self._session = graphs, session
        self._outputs: dict[tuple[str, str], Output] = {}  # by topic and type
        self._loaded: Any = None  # recording, topics
        self._read: Any = None  # what read_messages() returned for it

    def load(
        self, recording: Recording, topics: Sequence[str]
    ) -> tuple[list[Message], list[Callable[[], object]]]:
        """Return the messages for a Player, and what ends their motions, once all is connected.

        Raises BagError.
        """
        if self._loaded != (recording, topics):
            self._loaded = self._read = None  # It would need memory together with the next one.
            self._read = read_messages(recording.path, topics)
            self._loaded = recording, topics
        known, messages = self._read
        wanted = {(about.topic, about.md5sum): about for about in known.values()}
        self._open({key: about for key, about in wanted.items() if about.type != JOY})
        sends: dict[str, Send] = dict.fromkeys(known, self._move_joystick)
        ends: list[Callable[[], object]] = []
        for key, output in self._outputs.items():
            about = wanted[key]
            sends[about.topic] = partial(send, output)
            if about.type == VELOCITY:
                ends.append(partial(send, output, ZERO))
        return [(t, sends[topic], data) for t, topic, data in messages], ends

    def _move_joystick(self, data: bytes) -> None:
        joy = decoded(Joy, data, LONGEST_JOY)
        if joy is not None:
            self._session.play(joy.axes, joy.buttons)

    def _open(self, wanted: Mapping[tuple[str, str], Connection]) -> None:
        """Close the other publishers, open these, and wait a while for their subscribers."""
        for key in set(self._outputs) - set(wanted):
            self._outputs.pop(key).end()
        for key in set(wanted) - set(self._outputs):
            self._outputs[key] = output_of(wanted[key])
        end_s = time.monotonic() + CONNECT_S
        while not self._are_connected() and time.monotonic() < end_s:
            time.sleep(LOOK_S)

    def _are_connected(self) -> bool:
        subscribers = self._graphs.graph.subscribers
        return all(
            output.listeners >= len(subscribers.get(topic, ()))
            for (topic, _), output in self._outputs.items()
        )

    def close(self) -> None:
        self._loaded = self._read = None
        for key in list(self._outputs):
            self._outputs.pop(key).end()


def send(output: Output, data: bytes) -> None:
    output.publish(rospy.AnyMsg().deserialize(data))
