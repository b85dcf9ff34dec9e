"""The names of the services, which the node offers before the rest of it is loaded."""

# Methods of Field and of Turtle; the service types have the same names, or are Empty.
SERVICES = ("spawn", "kill", "clear", "reset")
OF_TURTLES = ("set_pen", "teleport_absolute", "teleport_relative")
AT_THE_START = (*SERVICES, *(f"turtle1/{service}" for service in OF_TURTLES))
