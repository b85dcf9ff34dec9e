"""A demonstration that reports what was driven."""
