"""The Debian packages of this suite: what is missing, and its installation. Needs only Python."""
