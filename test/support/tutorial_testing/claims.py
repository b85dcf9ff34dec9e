"""What a test shows: `@claim("sentence")`, from which test/claims.py writes test/CLAIMS.md."""

import pytest

claim = pytest.mark.claim
