"""`@claim("sentence")` says what a test shows; test/claims.py writes test/CLAIMS.md from them."""

import pytest

claim = pytest.mark.claim
