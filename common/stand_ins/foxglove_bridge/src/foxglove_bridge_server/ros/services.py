"""The services of a master, called with bytes."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import AbstractSet, Any, Callable

import rospy
from foxglove import MessageSchema, Schema, Service, ServiceRequest, ServiceSchema
from foxglove.websocket import WebSocketServer

from foxglove_bridge_server.messages import fits, serialised
from foxglove_bridge_server.ros.topic_channels import ENCODING, SCHEMAS
from node_kit.errors import ServiceError
from node_kit.ros.graph.services import call_service, kind_of

CALL_S = 30.0
ASKED_AT_ONCE = 4  # for their types; one that hangs does not delay the others


class Services:
    """Advertises services; the SDK calls each in a thread."""

    def __init__(self, server: WebSocketServer, warn: Callable[[str], object]) -> None:
        self._server, self._warn = server, warn
        self._names: frozenset[str] = frozenset()
        self._workers = ThreadPoolExecutor(ASKED_AT_ONCE)

    def show(self, names: AbstractSet[str]) -> None:
        """Advertise exactly these services, each once its type is known."""
        before, self._names = self._names, frozenset(names)
        self._server.remove_services(list(before - self._names))
        for name in self._names - before:
            self._workers.submit(self._advertise, name)

    def _advertise(self, name: str) -> None:
        try:
            kind = kind_of(name)
        except ServiceError as error:
            self._warn(f"{name} is not shown: {error}")
            return
        parts = [_schema(part) for part in (kind._request_class, kind._response_class)]
        schema = ServiceSchema(kind._type, request=parts[0], response=parts[1])
        if name in self._names:
            self._server.add_services([Service(name, schema=schema, handler=_caller(kind))])


def _schema(kind: Any) -> MessageSchema:
    schema = Schema(name=kind._type, encoding=SCHEMAS, data=kind._full_text.encode())
    return MessageSchema(encoding=ENCODING, schema=schema)


def _caller(kind: Any) -> Callable[[ServiceRequest], bytes]:
    raw = type("Raw", (), {"_md5sum": kind._md5sum, "_response_class": rospy.AnyMsg})

    def handle(request: ServiceRequest) -> bytes:
        if not fits(request.payload, kind._request_class):
            raise ServiceError(f"the request is not a {kind._request_class._type}")
        message = rospy.AnyMsg().deserialize(request.payload)
        return serialised(call_service(request.service_name, message, raw, CALL_S))

    return handle
