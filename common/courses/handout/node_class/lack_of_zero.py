"""Why a program in C++ sends no zero at Ctrl-C, as far as its text shows."""

from __future__ import annotations

from tutorial_check import SourceFacts

from .class_words import CPP

ZERO = "geometry_msgs::Twist()"


def lack_of_zero(facts: SourceFacts) -> tuple[int, str]:
    """Return (line or 0, hint or "").

    At Ctrl-C roscpp's own handler closes the topics, and then ros::ok() is false and ros::spin()
    returns: a zero arrives only if a handler of the program publishes before it calls
    ros::shutdown(). (Measured with roscpp 1.15.15.)
    """
    ending, handler = facts.ending, facts.first("on_shutdown")
    called = facts.called_by("on_shutdown", 0)
    name = handler.words[0] if handler else ""
    if ending.shutdown_first:
        return ending.shutdown_first, "ros::shutdown() closes the topics: first the zero, then this"
    if ending.sleep_first:
        return ending.sleep_first, "in the handler first the zero, then the sleep"
    if ending.replaced and not ending.own_sigint:
        hint = "ros::NodeHandle replaces this handler by roscpp's: give ros::init"
        return ending.replaced, f"{hint} ros::init_options::NoSigintHandler"
    if ending.late and not handler:
        hint = f"{ending.late_place} it is too late: Ctrl-C has closed the topics;"
        return ending.late, f"{hint} {CPP.stops_robot}"
    if ending.own_sigint and not handler:
        hint = "with NoSigintHandler Ctrl-C ends the program at once: signal(SIGINT, onCtrlC)"
        return ending.own_sigint, f"{hint}, in which it publishes {ZERO} and calls ros::shutdown()"
    if ending.unset_pointer and handler:
        return ending.unset_pointer, f"it points to no object: set it in main, for {name}"
    published = called.get("publish", [])
    if published:
        return published[0], f"publish {ZERO}, all zero"
    if handler and "signal_shutdown" in called:
        line = facts.functions.get(name, handler.line)
        return line, f"{name} has to publish {ZERO} before it calls ros::shutdown()"
    return next(iter(facts.lines("init_node")), 0), ""
