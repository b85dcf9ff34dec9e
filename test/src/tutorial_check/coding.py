"""From the bytes of a Python file to its lines. Pure."""

import io
import re

# In which a file is written, from a comment in the first or second line (PEP 263).
CODING = re.compile(rb"(?:[ \t\f]*(?:#[^\n]*)?\n)??[ \t\f]*#[^\n]*?coding[:=][ \t]*([-\w.]+)")


def unreadable(data):
    """(line, what is there) of the first thing in a file that is not of its coding; None if all is."""
    declared = CODING.match(data)
    coding = declared[1].decode() if declared else "utf-8"
    try:
        data.decode(coding)
    except UnicodeError as error:
        start = getattr(error, "start", 0)
        what = f"the byte 0x{data[start]:02x}, which is not {coding.upper()}"
        return data.count(b"\n", 0, start) + 1, what
    except LookupError:
        return data.count(b"\n", 0, declared.end()) + 1, f"a coding that is none, {coding}"
    return None


def python_lines(text):
    """The lines of a program as Python counts them; for splitlines() one also ends at a form feed or U+2028."""
    return [line.rstrip("\r\n") for line in io.StringIO(text, newline="")]
