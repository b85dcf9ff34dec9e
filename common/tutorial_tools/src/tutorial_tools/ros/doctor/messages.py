"""Decodes messages: transforms, stamps, diagnostics."""

from __future__ import annotations

import contextlib
import struct
from typing import Any, List, Tuple

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from genpy import DeserializationError
from tf2_msgs.msg import TFMessage

from tutorial_tools.doctor.facts import Offset, Transform
from tutorial_tools.doctor.transforms import TOPICS

Messages = List[Tuple[float, bytes]]  # (arrival [s], bytes)


def transforms_in(came: dict[tuple[str, str], Messages]) -> list[Transform]:
    """Return the transform to each frame that arrived with the least delay.

    came: {(node, topic): [(arrival [s], bytes)]}
    """
    fastest: dict[tuple[str, str], Transform] = {}
    of_tf = {key: messages for key, messages in came.items() if key[1] in TOPICS}
    for (node, topic), messages in of_tf.items():
        for at_s, data in messages:
            for stamped in getattr(decode(TFMessage, data), "transforms", ()):
                # Static transforms are valid at any time.
                late_s = 0.0 if topic == "/tf_static" else at_s - stamped.header.stamp.to_sec()
                parent, child = (
                    stamped.header.frame_id.strip("/"),
                    stamped.child_frame_id.strip("/"),
                )
                known = fastest.get((node, child))
                if known is None or late_s < known.late_s:
                    fastest[node, child] = Transform(node, parent, child, late_s)
    return list(fastest.values())


def offset(topic: str, messages: Messages) -> Offset | None:
    """Return how far stamps are ahead of their arrival, from the message with the least delay."""
    stamps = [(at_s, struct.unpack_from("<II", data, 4)) for at_s, data in messages if data[11:]]
    ahead = [seconds + nanoseconds * 1e-9 - at_s for at_s, (seconds, nanoseconds) in stamps]
    return Offset(max(ahead), topic) if ahead else None


def nearest(offsets: list[Offset | None]) -> Offset | None:
    """Return the smallest Offset: a larger one may be that of a recording, with old stamps."""
    return min(filter(None, offsets), key=lambda offset: abs(offset.seconds), default=None)


def base(name: str, said: list[DiagnosticStatus]) -> tuple[str, tuple[bool, str]] | None:
    """Return (node, (whether its packets arrive, battery)) of a Kobuki driver, else None."""
    about = {s.name.split(": ")[-1]: s for s in said if s.hardware_id == "Kobuki"}
    if not {"Watchdog", "Battery"} <= set(about):
        return None
    values = {pair.key: pair.value for pair in about["Battery"].values}
    battery = about["Battery"].message.lower(), f"{values.get('Voltage (V)')} V"
    state = values.get("Charging State", "").lower()
    return name, (about["Watchdog"].level == DiagnosticStatus.OK, ", ".join((*battery, state)))


def statuses(messages: Messages) -> list[DiagnosticStatus]:
    """Return what a node reports on /diagnostics."""
    arrays = [decode(DiagnosticArray, data) for _, data in messages]
    return [status for array in arrays if array for status in array.status]


def decode(kind: Any, data: bytes) -> Any:
    """Return the message, or None if it is malformed."""
    with contextlib.suppress(DeserializationError):
        return kind().deserialize(data)
    return None
