"""What a Kobuki is asked when it comes online: its versions, its number, its gains."""

from __future__ import annotations

from typing import Iterable

from kobuki_protocol.commands import Command, GetController, Request
from kobuki_protocol.identity import (
    DRIVEN_MAJOR,
    RECOMMENDED,
    Controller,
    FirmwareVersion,
    HardwareVersion,
    UniqueId,
)

ASK_S = 0.1  # between two questions, while it may still answer
PATIENCE_S = 2.0  # After so long without an answer it is taken for one of the usual firmware.
ASK_LATER_S = 5.0  # between two questions, then


class Identification:
    """Asks until the robot has answered, and judges its firmware."""

    def __init__(self) -> None:
        """Begin without a robot."""
        self.begin(0.0)

    def begin(self, now_s: float) -> None:
        """Forget the robot: the next one may be another."""
        self._began_s, self._asked_s = now_s, now_s - ASK_LATER_S
        self.hardware: HardwareVersion | None = None
        self.firmware: FirmwareVersion | None = None
        self.unique_id: UniqueId | None = None
        self.controller: Controller | None = None

    def take(self, parts: Iterable[object]) -> list[object]:
        """Take the parts of a packet; return those that are answers."""
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

    def questions(self, now_s: float) -> list[Command]:
        """Return what to ask now."""
        every_s = ASK_S if now_s - self._began_s < PATIENCE_S else ASK_LATER_S
        if now_s - self._asked_s < every_s:
            return []
        versions = None in (self.hardware, self.firmware, self.unique_id)
        asked: list[Command] = [Request()] if versions else []
        if self.controller is None:
            asked.append(GetController())
        if asked:
            self._asked_s = now_s
        return asked

    def may_drive(self, now_s: float) -> bool:
        """Return whether the robot is known to obey our commands, or does not say."""
        if self.firmware is None:
            return now_s - self._began_s >= PATIENCE_S
        return self.firmware.is_driven

    def objection(self) -> str:
        """Return one line on the firmware, if there is something to be said."""
        if self.firmware is None or self.firmware.is_recommended:
            return ""
        if not self.firmware.is_driven:
            what = (
                "update the robot's"
                if self.firmware.major < DRIVEN_MAJOR
                else "look for a newer driver"
            )
            return (
                f"firmware {self.firmware}: this driver knows {DRIVEN_MAJOR}.x and does not drive "
                f"the robot; {what} (https://kobuki.readthedocs.io/en/devel/firmware.html)"
            )
        newer = ".".join(map(str, RECOMMENDED))
        return (
            f"firmware {self.firmware} is driven; {newer} or newer is recommended "
            "(https://kobuki.readthedocs.io/en/devel/firmware.html)"
        )
