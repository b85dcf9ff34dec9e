"""Two hosts and a cable, in network namespaces."""
