"""Python 2, by the errors that Python 3 makes of it: all that 2to3 fixes, by its fixers. Pure."""

from __future__ import annotations

import re

MODULES = """
BaseHTTPServer ConfigParser Cookie HTMLParser Queue ScrolledText SimpleHTTPServer SimpleXMLRPCServer
SocketServer StringIO Tix Tkinter __builtin__ cPickle cStringIO commands cookielib copy_reg httplib
htmlentitydefs thread tkColorChooser tkFileDialog tkFont tkMessageBox tkSimpleDialog ttk urllib2
urlparse xmlrpclib
"""
NAMES = "apply basestring execfile intern long raw_input reduce reload unichr unicode xrange"
INNER = "getcwdu ifilter imap izip maxint quote unquote urlencode urlopen urlretrieve"  # in modules
LISTS = [f"(?:{'|'.join(words.split())})" for words in (MODULES, NAMES, INNER)]
# In an error of Python 3, or in the program's line, which follows it.
MARKS = re.compile(
    rf"No module named '{LISTS[0]}[.']|name '{LISTS[1]}' is not defined"
    rf"|module '\w+' has no attribute '{LISTS[2]}'|import name '{LISTS[2]}' from '(?:itertools|urllib)'"
    r"|'dict' object has no attribute '(?:has_key|(?:iter|view)\w+)'|no attribute 'next'"
    r"|for >>: 'builtin_function_or_method'|for %: 'NoneType'[^\n]*\n.*\bprint\b"
    r"|call to '(?:print|exec)'|leading zeros in decimal|\n\s*def\s+\w+\((?:[^=()]*,)?\s*\("
    # print x; exec x; raise X, "text"; except X, e; `x`, <>, 10L, ur"x".
    r"|\n(?:[^\"'#]*[:;])?\s*(?:print\s+[^(=\s]|exec\s+[\w\"']|raise\s+[\w.]+\s*,)"
    r"|\n\s*except\s+(?:[\w.]+|\([^()]*\))\s*,\s*\w+\s*:"
    r"|\n[^\"'#]*(?:`[^`]*`|<>|\b\d+[lL]\b|\bur[\"'])"
)


def porting(error: str, line: str, file: str) -> str:
    """Return what to do if an error of Python 3 in a line comes of Python 2, else "". file: for a shell."""
    if not MARKS.search(f"{error}\n{line}"):
        return ""
    # Debian 13 has no 2to3; python3-fissix, which is the same, comes with the set-up.
    other = f"where there is no 2to3: /usr/bin/python3 -m fissix -w {file}"
    return f"this is Python 2: 2to3 -w {file} makes it Python 3 ({other})"
