"""The requests to a Kobuki that comes online: for its versions, its unique id, its gains."""

from __future__ import annotations

from typing import Iterable

from kobuki_protocol.commands import Command, GetController, IdentityRequest
from kobuki_protocol.identity import (
    RECOMMENDED,
    SUPPORTED_MAJOR,
    Controller,
    FirmwareVersion,
    HardwareVersion,
    UniqueId,
)

FIRMWARE_PAGE = "https://kobuki.readthedocs.io/en/devel/firmware.html"
ASK_S = 0.1  # between two requests, within PATIENCE_S
PATIENCE_S = 2.0  # without an answer for this long, the firmware counts as supported
ASK_LATER_S = 5.0  # between two requests after that


class Identification:
    """Repeats the requests until the robot has answered, and checks its firmware."""

    def __init__(self) -> None:
        """Start without a robot."""
        self.begin(0.0)

    def begin(self, now_s: float) -> None:
        """Forget all answers: this may be another robot."""
        self._began_s, self._asked_s = now_s, now_s - ASK_LATER_S
        self.hardware: HardwareVersion | None = None
        self.firmware: FirmwareVersion | None = None
        self.unique_id: UniqueId | None = None
        self.controller: Controller | None = None

    def take(self, parts: Iterable[object]) -> list[object]:
        """Return those parts of a packet that are answers, and remember them."""
        answers: list[object] = []
        for part in parts:
            if isinstance(part, HardwareVersion):
                self.hardware = part
            elif isinstance(part, FirmwareVersion):
                self.firmware = part
            elif isinstance(part, UniqueId):
                self.unique_id = part
            elif isinstance(part, Controller):
                self.controller = part
            else:
                continue
            answers.append(part)
        return answers

    def requests(self, now_s: float) -> list[Command]:
        """Return the requests that are due now."""
        every_s = ASK_S if now_s - self._began_s < PATIENCE_S else ASK_LATER_S
        if now_s - self._asked_s < every_s:
            return []
        versions = None in (self.hardware, self.firmware, self.unique_id)
        requests: list[Command] = [IdentityRequest()] if versions else []
        if self.controller is None:
            requests.append(GetController())
        if requests:
            self._asked_s = now_s
        return requests

    def may_drive(self, now_s: float) -> bool:
        """Return whether the firmware is supported, or has not answered within PATIENCE_S."""
        if self.firmware is None:
            return now_s - self._began_s >= PATIENCE_S
        return self.firmware.is_supported

    def objection(self) -> str:
        """Return a line about firmware that is not recommended, or ""."""
        if self.firmware is None or self.firmware.is_recommended:
            return ""
        if not self.firmware.is_supported:
            what = (
                "update the robot's"
                if self.firmware.major < SUPPORTED_MAJOR
                else "look for a newer driver"
            )
            return (
                f"firmware {self.firmware}: this driver supports only {SUPPORTED_MAJOR}.x, and "
                f"does not drive the robot; {what} ({FIRMWARE_PAGE})"
            )
        newer = ".".join(map(str, RECOMMENDED))
        return (
            f"firmware {self.firmware} is supported; {newer} or newer is recommended "
            f"({FIRMWARE_PAGE})"
        )
