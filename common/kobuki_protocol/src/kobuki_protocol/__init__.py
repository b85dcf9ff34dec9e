"""The protocol between a Kobuki and its driver.

The facts are those of kobuki_driver's appendix "Protocol Specification" and of its sources
(yujinrobot/kobuki_core), where a constant names no other source.
"""
