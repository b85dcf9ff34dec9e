"""What a Kobuki and its driver send each other.

The facts are those of kobuki_driver's appendix "Protocol Specification" and of its sources
(yujinrobot/kobuki_core), where a constant names no other source.
"""
