"""Adds a method to the XML-RPC interface of a node, which no ROS tool lists."""

from __future__ import annotations

from typing import Any, Callable

from rospy.impl.masterslave import ROSHandler


def answer(question: str, reply: Callable[..., Any]) -> None:
    """Answer ros_api.call(address of this node, question, ...) with reply(...)."""

    def handle(_handler: Any, _caller: str, *arguments: Any) -> tuple[int, str, Any]:
        return 1, "", reply(*arguments)

    setattr(ROSHandler, question, handle)
