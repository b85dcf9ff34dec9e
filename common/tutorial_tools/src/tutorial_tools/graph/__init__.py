"""A picture of the running nodes and topics."""
