"""What the node says about itself on /diagnostics, once a second."""

import diagnostic_updater
from diagnostic_msgs.msg import DiagnosticStatus


class Diagnostics:
    """Counts what happened since the last report and reports it."""

    def __init__(self, topics, rate):
        """Take the RobotTopics of all robots and the rate [Hz] they are published at."""
        self._topics = topics
        self._rate = rate
        self._cycles = self._missed = self._reported_rejected = 0
        self._updater = diagnostic_updater.Updater()
        self._updater.setHardwareID("none (simulated)")
        self._updater.add("simulation", self._report)

    def count(self, missed):
        """Count one cycle and the periods missed before it; report once a second."""
        self._cycles += 1
        self._missed += missed
        if self._cycles + self._missed >= self._rate:
            self._updater.force_update()
            self._cycles = self._missed = 0

    def _report(self, status):
        rejected = sum(topics.rejected for topics in self._topics)
        if self._missed:
            status.summary(
                DiagnosticStatus.WARN, "periods missed: busy, or /clock is slower than ~rate"
            )
        elif rejected > self._reported_rejected:
            status.summary(DiagnosticStatus.WARN, "commands that are not finite were ignored")
        else:
            status.summary(DiagnosticStatus.OK, "running")
        self._reported_rejected = rejected
        status.add("robots", len(self._topics))
        status.add("robots under command", sum(t.robot.is_driven for t in self._topics))
        status.add("rate [Hz]", self._rate)
        status.add("periods missed in the last second", self._missed)
        status.add("commands rejected since the start", rejected)
        return status
