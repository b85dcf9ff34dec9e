# C++ compilers look here before the system's folders. A ROS in /opt/ros comes first, by -I.
@[if DEVELSPACE]@
_headers="@(CMAKE_CURRENT_SOURCE_DIR)/noetic_headers"
@[else]@
_headers="$CATKIN_ENV_HOOK_WORKSPACE/share/tutorial_tools/noetic_headers"
@[end if]@
case ":${CPLUS_INCLUDE_PATH-}:" in
*":$_headers:"*) ;;
*) export CPLUS_INCLUDE_PATH="$_headers${CPLUS_INCLUDE_PATH:+:$CPLUS_INCLUDE_PATH}" ;;
esac
unset _headers
