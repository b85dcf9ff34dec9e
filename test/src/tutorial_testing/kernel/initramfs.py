"""An initramfs: the little file system with which a kernel starts (pure but for reading modules).

Format "newc" of Documentation/driver-api/early-userspace/buffer-format.rst in the kernel's sources.
"""

import lzma
import re
import stat
from pathlib import Path


def archive(files):
    """The bytes of a cpio archive. files: dict from path to (mode, bytes), folders first."""
    parts = []
    for inode, (name, (mode, data)) in enumerate([*files.items(), ("TRAILER!!!", (0, b""))], 1):
        path = name.encode() + b"\0"
        numbers = (inode, mode, 0, 0, 1, 0, len(data), 0, 0, 0, 0, len(path), 0)
        head = b"070701" + b"".join([b"%08X" % number for number in numbers])
        parts += [_padded(head + path), _padded(data)]
    return b"".join(parts)


def folder(path):
    """An entry for archive()."""
    return {path: (stat.S_IFDIR | 0o755, b"")}


def program(path, data):
    """An entry for archive()."""
    return {path: (stat.S_IFREG | 0o755, data)}


def _padded(data):
    return data + b"\0" * (-len(data) % 4)


def modules(tree, wanted):
    """{name: bytes} of kernel modules and of those they need, in the order in which to load them.

    tree: lib/modules/VERSION of a kernel. What is built into the kernel has no file, and is left
    out.
    """
    files = {path.name.split(".")[0].replace("-", "_"): path for path in Path(tree).rglob("*.ko*")}
    loaded = {}

    def load(name):
        if name in loaded or name not in files:
            return
        data = files[name].read_bytes()
        if files[name].suffix == ".xz":
            data = lzma.decompress(data)
        needed = re.search(rb"\0depends=([^\0]*)\0", data)
        for other in needed[1].decode().replace("-", "_").split(",") if needed else ():
            load(other)
        loaded[name] = data

    for name in wanted:
        load(name)
    return loaded
