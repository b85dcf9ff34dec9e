"""Random faults on the live system: ./tutorial test faults."""
