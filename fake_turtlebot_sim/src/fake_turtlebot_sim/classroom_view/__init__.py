"""What RViz shows of a classroom: a body and a name for every robot."""
