"""Section 4.3: joy2twist."""
