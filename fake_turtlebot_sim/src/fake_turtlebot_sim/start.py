"""The start of a node: mistakes are one clear line and exit code 1, before anything moves."""

import sys

import rosgraph
import rospy

from fake_turtlebot_sim.ending import end_on_signals


def run(name, parse, spin):
    """Run spin(parse(private parameters)) as the node `name`; return its exit code.

    Mistakes in the parameters are ValueErrors of parse, with one line each.
    """
    # Before init_node, which waits for a master without an end.
    try:
        if not rosgraph.is_master_online():
            return _fail(name, f"no ROS master at {rosgraph.get_master_uri()}: start roscore")
    except ValueError:
        return _fail(
            name,
            f"ROS_MASTER_URI is {rosgraph.get_master_uri()!r}:"
            " must be an address such as http://localhost:11311",
        )
    end_on_signals()
    try:
        rospy.init_node(name, disable_signals=True)
        try:
            parameters = parse(rospy.get_param("~", {}))
        except ValueError as error:
            rospy.logfatal("%s", error)
            # What the command line sets stays on the master; it would spoil the next start too.
            for parameter in rospy.client.load_command_line_node_params(sys.argv):
                rospy.delete_param(f"~{parameter}")
            return 1
        spin(parameters)
    except rospy.ROSException:
        # A shutdown in the middle of the start, or one that closes a topic while it is published.
        # is_shutdown() becomes true only after the topics are closed.
        if not rospy.core.is_shutdown_requested():
            raise
    return 0


def _fail(name, line):
    print(f"{name}: {line}", file=sys.stderr)
    return 1
