"""Words for folders in recordings, because paths differ between machines."""

from __future__ import annotations

import dataclasses
import re
from pathlib import Path
from typing import Any, Mapping, TypeVar

Part = TypeVar("Part")  # a recording, or a part of one


class Places:
    """Replaces this machine's folders in a recording by words, and words by folders."""

    def __init__(self, folders: Mapping[str, Path]) -> None:
        """folders: {word: path}; / and relative paths are ignored."""
        known = {word: path for word, path in folders.items() if path.root and path.name}
        self._folders = {f"{{{word}}}": str(path) for word, path in known.items()}
        self._words = {path: word for word, path in self._folders.items()}
        inner_first = sorted(map(re.escape, self._words), key=len, reverse=True)
        self._path = re.compile(rf"({'|'.join(inner_first) or '(?!)'})(?![\w-])")
        self._word = re.compile("|".join(map(re.escape, self._folders)) or "(?!)")

    def named(self, part: Part) -> Part:
        """Return a recording with words instead of folders."""
        return _replaced(part, self._path, self._words)

    def whole(self, part: Part) -> Part:
        """Return a recording with this machine's folders instead of words."""
        return _replaced(part, self._word, self._folders)


def _replaced(part: Any, pattern: re.Pattern[str], words: Mapping[str, str]) -> Any:
    """Return a recording, or a part of it, with all matches in its texts replaced."""

    def word(fit: re.Match[str]) -> str:
        return words[fit[0]]

    def replaced(inner: Any) -> Any:
        if isinstance(inner, str):
            return pattern.sub(word, inner)
        if isinstance(inner, Path):
            return Path(replaced(str(inner)))
        if isinstance(inner, (list, tuple)):
            return type(inner)(map(replaced, inner))
        if isinstance(inner, dict):
            return {replaced(key): replaced(value) for key, value in inner.items()}
        if dataclasses.is_dataclass(inner):
            names = [field.name for field in dataclasses.fields(inner)]
            make: Any = type(inner)
            return make(**{name: replaced(getattr(inner, name)) for name in names})
        return inner

    return replaced(part)
