"""Makes one gamepad look like another: the node joy_remap of the package joy."""
