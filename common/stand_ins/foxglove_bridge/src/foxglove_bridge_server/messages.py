"""Messages as bytes, with the classes of genpy."""

from __future__ import annotations

from io import BytesIO
from typing import Any


def serialised(message: Any) -> bytes:
    """Return the bytes of a message."""
    buffer = BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def fits(data: bytes, kind: Any) -> bool:
    """Return whether bytes are a message of a class. genpy alone takes texts that are cut off."""
    try:
        return serialised(kind().deserialize(data)) == data
    except Exception:  # malformed bytes may raise anything
        return False
