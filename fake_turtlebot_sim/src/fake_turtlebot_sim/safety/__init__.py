"""The rules of the safety controller, which backs a bumped robot away."""
