"""The live hunt: a system that is driven by random hands and hit by random faults."""
