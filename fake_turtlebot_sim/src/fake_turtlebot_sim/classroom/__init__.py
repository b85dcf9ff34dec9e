"""Bodies and names of a classroom's robots for RViz: the node classroom_bodies."""
