"""The services of a master, called with bytes."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from io import BytesIO
from typing import AbstractSet, Any, Callable

import rospy
from foxglove import MessageSchema, Schema, Service, ServiceRequest, ServiceSchema
from foxglove.websocket import WebSocketServer

from foxglove_bridge_server.ros.topic_channels import ENCODING, SCHEMAS
from node_kit.errors import ServiceError
from node_kit.ros.graph.services import call_service, kind_of

CALL_S = 30.0
ASKED_AT_ONCE = 4  # A service that hangs delays the types of the others no more than that.


class Services:
    """Advertises services; the SDK calls each in a thread."""

    def __init__(self, server: WebSocketServer, warn: Callable[[str], object]) -> None:
        self._server, self._warn = server, warn
        self._names: set[str] = set()
        self._advertised: set[str] = set()
        self._workers = ThreadPoolExecutor(ASKED_AT_ONCE)

    def show(self, names: AbstractSet[str]) -> None:
        """Advertise exactly these services, as soon as each has told its type."""
        gone, new = self._names - names, names - self._names
        self._names = set(names)
        self._server.remove_services(list(gone & self._advertised))
        self._advertised -= gone
        for name in new:
            self._workers.submit(self._advertise, name)

    def _advertise(self, name: str) -> None:
        try:
            kind = kind_of(name)
        except ServiceError as error:
            self._warn(f"{name} is not shown: {error}")
            return
        if name in self._names:
            parts = _part(kind._request_class), _part(kind._response_class)
            schema = ServiceSchema(kind._type, request=parts[0], response=parts[1])
            self._advertised.add(name)
            self._server.add_services([Service(name, schema=schema, handler=_Handler(kind))])


def _part(kind: Any) -> MessageSchema:
    schema = Schema(name=kind._type, encoding=SCHEMAS, data=kind._full_text.encode())
    return MessageSchema(encoding=ENCODING, schema=schema)


class _Handler:
    """Calls a service; takes and returns bytes."""

    def __init__(self, kind: Any) -> None:
        self._request = kind._request_class
        names = {"_md5sum": kind._md5sum, "_response_class": rospy.AnyMsg}
        self._raw = type("Raw", (), names)

    def __call__(self, request: ServiceRequest) -> bytes:
        try:
            self._request().deserialize(request.payload)
        except Exception:  # malformed bytes may raise anything
            raise ServiceError(f"the request is no {self._request._type}") from None
        raw = rospy.AnyMsg().deserialize(request.payload)  # both only keep the bytes
        response = BytesIO()
        call_service(request.service_name, raw, self._raw, CALL_S).serialize(response)
        return response.getvalue()
