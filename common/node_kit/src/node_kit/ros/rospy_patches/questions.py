"""Adds a question to those that a node answers by XML-RPC, which no list of ROS shows."""

from __future__ import annotations

from typing import Any, Callable

from rospy.impl.masterslave import ROSHandler


def answer(question: str, reply: Callable[..., Any]) -> None:
    """Have this node answer ros_api.call(its address, question, ...) with reply(...)."""

    def handle(_handler: Any, _caller: str, *arguments: Any) -> tuple[int, str, Any]:
        return 1, "", reply(*arguments)

    setattr(ROSHandler, question, handle)
