"""Convert recordings to JSON and back.

A recording is a frozen dataclass. Its fields are texts, numbers, booleans, None, paths, other such
dataclasses, or tuples and maps of these, as their annotations say.
"""

from __future__ import annotations

import dataclasses
import inspect
from pathlib import Path
from typing import (
    Any,
    Callable,
    Dict,
    List,
    Sequence,
    Tuple,
    TypeVar,
    Union,
    cast,
    get_args,
    get_origin,
    get_type_hints,
)

from tutorial_check.errors import CannotCheck

Recording = TypeVar("Recording")


def as_json(value: object) -> object:
    """Return a recording, or a part of it, in a form that json.dumps takes."""
    if dataclasses.is_dataclass(value):
        names = (field.name for field in dataclasses.fields(value))
        return {name: as_json(getattr(value, name)) for name in names}
    if isinstance(value, dict):
        return {str(key): as_json(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return list(map(as_json, value))
    return str(value) if isinstance(value, Path) else value


def from_json(kind: type[Recording], value: object) -> Recording:
    """Return the recording from what as_json() returned. Raises ValueError if it does not fit."""
    try:
        return cast(Recording, _from_json(kind, value))
    except (AttributeError, KeyError, TypeError) as error:
        raise ValueError(f"no {getattr(kind, '__name__', kind)}: {error}") from None


def _from_json(kind: Any, value: Any) -> Any:
    origin: Any = getattr(kind, "__origin__", None)
    inner: Any = getattr(kind, "__args__", ())
    if dataclasses.is_dataclass(kind):
        kinds, make = get_type_hints(kind), cast(Any, kind)
        return make(**{name: _from_json(kinds[name], part) for name, part in value.items()})
    if origin is Union:  # Optional
        return None if value is None else _from_json(inner[0], value)
    if origin in (tuple, Tuple):
        if inner[-1] is Ellipsis:
            return tuple(_from_json(inner[0], part) for part in value)
        return tuple(map(_from_json, inner, value))
    if origin in (dict, Dict):
        return {key: _from_json(inner[1], part) for key, part in value.items()}
    if origin in (list, List):
        return [_from_json(inner[0], part) for part in value]
    return kind(value) if kind in (float, Path) else value


def arguments_of(recorder: Callable[..., object], values: Sequence[object]) -> List[object]:
    """Return a recorder's arguments, after the workspace, from what as_json() returned."""
    kinds, names = get_type_hints(recorder), list(inspect.signature(recorder).parameters.values())
    arguments = []
    for number, value in enumerate(values, 1):
        parameter = names[min(number, len(names) - 1)]  # the last may be *arguments
        arguments.append(_from_json(kinds.get(parameter.name, Any), value))
    return arguments


def must_be_whole(recorded: type) -> None:
    """Raise CannotCheck for a recording with a list or map whose annotation omits its items."""
    kinds: list[Any] = [recorded]
    for kind in kinds:
        for name, hint in get_type_hints(kind).items():
            parts = [hint]
            for part in parts:
                if (get_origin(part) or part) in (list, tuple, dict) and not get_args(part):
                    how = "its type must name its items, such as Tuple[float, ...]"
                    raise CannotCheck(f"{kind.__name__}.{name}: {how}")
                parts += get_args(part)
            inner = filter(dataclasses.is_dataclass, parts)
            kinds += [part for part in inner if part not in kinds]
