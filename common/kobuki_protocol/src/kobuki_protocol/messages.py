"""A Kobuki's values as messages of mobile_base, for the driver and the simulation."""

from __future__ import annotations

from math import cos, sin
from sys import float_info
from typing import Any, Sequence

from geometry_msgs.msg import Quaternion, Vector3
from kobuki_msgs.msg import ControllerInfo, DockInfraRed, SensorState, VersionInfo
from sensor_msgs.msg import Imu
from std_msgs.msg import Header, String

from kobuki_protocol.feedback import Feedback, RawGyro
from kobuki_protocol.identity import Controller, FirmwareVersion, HardwareVersion, UniqueId

GYRO_FRAME, DOCK_FRAME = "gyro_link", "dock_ir_link"  # kobuki_description
# Of orientation and turn rate [rad2, rad2/s2]; x and y are unknown (slot_callbacks.cpp).
COVARIANCE = (float_info.max, 0.0, 0.0, 0.0, float_info.max, 0.0, 0.0, 0.0, 0.05)
ALL_FEATURES = VersionInfo.SMOOTH_MOVE_START | VersionInfo.GYROSCOPE_3D_DATA


def sensor_state(feedback: Feedback, stamp: Any) -> SensorState:
    """Return the message of sensors/core."""
    core, cliff, current = feedback.core, feedback.cliff, feedback.current
    return SensorState(
        Header(0, stamp, ""),
        core.time_stamp,
        core.bumper,
        core.wheel_drop,
        core.cliff,
        core.left_encoder,
        core.right_encoder,
        core.left_pwm,
        core.right_pwm,
        core.buttons,
        core.charger,
        core.battery,
        [cliff.right, cliff.center, cliff.left],
        [current.left, current.right],
        core.overcurrent,
        feedback.inputs.digital,
        list(feedback.inputs.analog),
    )


def dock_infrared(feedback: Feedback, stamp: Any, prefix: str = "") -> DockInfraRed:
    """Return the message of sensors/dock_ir; prefix: for its frame."""
    dock = feedback.dock
    data = bytes((dock.right, dock.center, dock.left))
    return DockInfraRed(Header(0, stamp, prefix + DOCK_FRAME), data)


def imu(heading: float, rate: float, stamp: Any, prefix: str = "") -> Imu:
    """Return the message of sensors/imu_data: heading [rad] and rate [rad/s] about z."""
    message = _turning((0.0, 0.0, rate), stamp, prefix)
    message.orientation = Quaternion(0.0, 0.0, sin(0.5 * heading), cos(0.5 * heading))
    message.orientation_covariance = message.angular_velocity_covariance = COVARIANCE
    return message


def raw_imu(gyro: RawGyro, stamps: Sequence[Any], prefix: str = "") -> list[Imu]:
    """Return the messages of sensors/imu_data_raw; stamps: one for each reading."""
    return [_turning(rates, stamp, prefix) for rates, stamp in zip(gyro.rates, stamps)]


def _turning(rates: Sequence[float], stamp: Any, prefix: str) -> Imu:
    header = Header(0, stamp, prefix + GYRO_FRAME)
    return Imu(header=header, angular_velocity=Vector3(*rates))


def version_info(
    hardware: HardwareVersion, firmware: FirmwareVersion, unique_id: UniqueId, software: str
) -> VersionInfo:
    """Return the message of version_info; firmware newer than 1.0.0 has all features."""
    has_features = (firmware.major, firmware.minor, firmware.patch) > (1, 0, 0)
    features = ALL_FEATURES if has_features else 0
    return VersionInfo(str(hardware), str(firmware), software, list(unique_id.words), features)


def controller_info(controller: Controller) -> ControllerInfo:
    """Return the message of controller_info."""
    return ControllerInfo(controller.kind, *(0.001 * gain for gain in controller.gains))


def stream_text(packet: bytes) -> String:
    """Return the message of debug/raw_data_stream for a packet of the robot."""
    return String(f"{{ {packet.hex(' ').upper()} }}")


def command_text(packet: bytes) -> String:
    """Return the message of debug/raw_data_command for a packet of the driver."""
    return String(f"[ {' '.join(f'0x{byte:02x}' for byte in packet)} ]")
