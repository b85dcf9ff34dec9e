"""What is checked before a node starts: the master and the private parameters."""

import sys

import rosgraph
import rospy


class StartError(Exception):
    """The node cannot start; the text says in one line why and what to do."""


def checked_parameters(node_name, load):
    """What load() makes of the private parameters, those of the master and the command line.

    Before rospy.init_node(): that would first end a node of the same name that runs well, and put
    a wrong parameter of the command line on the parameter server, where it would stay.

    node_name: unless __name:= is given. load: takes a dict and raises ValueError with one line.
    Raises StartError.
    """
    name = rosgraph.names.ns_join(
        rosgraph.names.get_ros_namespace(), rospy.names.get_mappings().get("__name", node_name)
    )
    try:
        online = rosgraph.is_master_online()
    except ValueError:
        online = False
    if not online:
        raise StartError(
            f"no ROS master at {rosgraph.get_master_uri()}: "
            "start roscore first, or set ROS_MASTER_URI to where it runs."
        )
    try:
        given = rospy.get_param(name, {})
        for key, value in rospy.client.load_command_line_node_params(sys.argv).items():
            _set(given, key.split("/"), value)
        return load(given)
    except ValueError as error:
        raise StartError(f"{error} (~ stands for {name}/)") from None
    except rospy.ROSException as error:
        raise StartError(" ".join(str(error).split())) from None


def _set(parameters, path, value):
    """Set a parameter of a nested dict, as a/b:=value does."""
    *outer, last = path
    for key in outer:
        parameters = parameters.setdefault(key, {})
    parameters[last] = value
