"""The events of the Kobuki's sensors, in the order of simulator.sensors.Sensed."""

from kobuki_msgs.msg import BumperEvent, CliffEvent, WheelDropEvent

QUEUE = 30  # none of them may be lost
# Their topic, their message, and the field that says which sensor it was.
EVENTS = (
    ("bumper", BumperEvent, "bumper"),
    ("cliff", CliffEvent, "sensor"),
    ("wheel_drop", WheelDropEvent, "wheel"),
)
