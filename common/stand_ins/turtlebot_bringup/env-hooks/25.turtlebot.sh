# What launch files for a TurtleBot read by $(env ...), unless it is set: turtlebot_bringup's names.
: "${TURTLEBOT_BASE:=kobuki}" "${TURTLEBOT_STACKS:=hexagons}" "${TURTLEBOT_3D_SENSOR:=kinect}"
: "${TURTLEBOT_BATTERY:=/sys/class/power_supply/BAT0}" "${TURTLEBOT_SERIAL_PORT:=/dev/kobuki}"
: "${TURTLEBOT_NAME:=turtlebot}" "${TURTLEBOT_TYPE:=turtlebot}" "${TURTLEBOT_SIMULATION:=false}"
export TURTLEBOT_BASE TURTLEBOT_STACKS TURTLEBOT_3D_SENSOR TURTLEBOT_BATTERY
export TURTLEBOT_SERIAL_PORT TURTLEBOT_NAME TURTLEBOT_TYPE TURTLEBOT_SIMULATION
