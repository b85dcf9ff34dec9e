"""Recorders by name: a check asks for a recording without importing what starts programs."""

from __future__ import annotations

from dataclasses import dataclass, is_dataclass
from typing import Any, Callable, Generic, Type, TypeVar, cast, get_type_hints

from tutorial_check.data.json_data import must_be_whole
from tutorial_check.data.recordings import Built, Installed, ReadLaunchFiles

Recording = TypeVar("Recording")


@dataclass(frozen=True)
class RecorderName(Generic[Recording]):
    """A function that a worker calls with a workspace and arguments, and the type it returns."""

    name: str  # MODULE:NAME
    kind: Type[Recording]


def name_of(recorder: Callable[..., Recording]) -> RecorderName[Recording]:
    """Return the name of a recorder. Raises TypeError if it does not name what it returns."""
    kind: Any = get_type_hints(recorder).get("return")
    if not is_dataclass(kind):
        raise TypeError(f"{recorder.__name__}() has to name the dataclass that it returns: ->")
    whole = cast(Type[Recording], kind)
    must_be_whole(whole)
    return RecorderName(f"{recorder.__module__}:{recorder.__name__}", whole)


BUILT = RecorderName("tutorial_check.recording.build:built", Built)
OWN_BUILT = RecorderName("tutorial_check.recording.build:own_built", Built)
INSTALLED = RecorderName("tutorial_check.recording.build:installed", Installed)
LAUNCH_FILES = RecorderName(
    "tutorial_check.recording.launch_files:read_launch_files", ReadLaunchFiles
)
