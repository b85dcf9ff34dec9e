// Debian's ROS headers no longer bring boost's _1, _2, ... into the global namespace, as Noetic's do and
// boost::bind(callback, _1) of the ROS wiki needs. This file comes before Debian's, for C++ alone.
#include_next <ros/node_handle.h>
using namespace boost::placeholders;
