"""The serial protocol of a Kobuki, as bytes; kobuki_driver's appendix describes it."""
