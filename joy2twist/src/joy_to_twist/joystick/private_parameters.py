"""The private parameters of a node, read before it starts."""

import sys

import rosgraph
import rospy

from joy_to_twist.start import StartError


def given_parameters(default_name):
    """The private parameters (dict) of the node, from the master and the command line.

    Before rospy.init_node(): that would first end a node of the same name that runs well, and put
    a wrong parameter of the command line on the parameter server, where it would stay.
    default_name: of the node, unless __name:= is given. Raises StartError.
    """
    name = rospy.names.get_mappings().get("__name", default_name)
    try:
        online = rosgraph.is_master_online()
    except ValueError:
        online = False
    if not online:
        raise StartError(
            f"no ROS master answers at {rosgraph.get_master_uri()}: "
            "start roscore first, or set ROS_MASTER_URI to where it runs."
        )
    full_name = rosgraph.names.ns_join(rosgraph.names.get_ros_namespace(), name)
    try:
        given = rospy.get_param(full_name, {})
        return {**given, **rospy.client.load_command_line_node_params(sys.argv)}
    except rospy.ROSException as error:
        raise StartError(" ".join(str(error).split())) from None
