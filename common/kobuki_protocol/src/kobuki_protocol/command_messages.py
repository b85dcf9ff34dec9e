"""Conversion of messages on mobile_base/commands to a Kobuki's commands."""

from __future__ import annotations

from typing import Any, Callable

from kobuki_msgs.msg import ControllerInfo, DigitalOutput, ExternalPower, Led, Sound

from kobuki_protocol.commands import Command, Outputs, SetController, SoundSequence

TOPICS: dict[str, type] = {
    "led1": Led,
    "led2": Led,
    "sound": Sound,
    "digital_output": DigitalOutput,
    "external_power": ExternalPower,
    "controller_info": ControllerInfo,
}


class CommandEncoder:
    """Converts messages to commands; keeps the command that pins, supplies and LEDs share."""

    def __init__(self) -> None:
        """Start as the Kobuki's driver does: with all supplies on."""
        self.outputs = Outputs()
        self._with: dict[str, Callable[[Any], Outputs]] = {
            "led1": lambda led: self.outputs.with_led(1, led.value),
            "led2": lambda led: self.outputs.with_led(2, led.value),
            "digital_output": lambda pins: self.outputs.with_pins(pins.values, pins.mask),
            "external_power": lambda power: self.outputs.with_power(power.source, power.state),
        }

    def command(self, topic: str, message: object) -> Command:
        """Return the command of a message on one of the TOPICS. Raises ValueError, one line."""
        if isinstance(message, Sound):
            return SoundSequence.of(message.value)
        if isinstance(message, ControllerInfo):
            gains = message.p_gain, message.i_gain, message.d_gain
            return SetController.of(message.type, gains)
        self.outputs = self._with[topic](message)
        return self.outputs
