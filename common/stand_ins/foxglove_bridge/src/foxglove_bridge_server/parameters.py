"""The private parameters of the bridge, those of foxglove_bridge for ROS 1, and their checks."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Iterable, Mapping, Pattern, Tuple

from node_kit.parameters.declaration import (
    Allowed,
    checked,
    declared,
    number,
    parameter,
    switch,
    text,
    whole_number,
)

CAPABILITIES = ("clientPublish", "parameters", "parametersSubscribe", "services")
CAPABILITIES += ("connectionGraph", "assets")
ASSETS = (
    r"^package://(?:[-\w%]+/)*[-\w%.]+\.(?:dae|fbx|glb|gltf|jpe?g|mtl|obj|png|stl|tiff?|urdf|webp)$"
)
WITHOUT_EFFECT = (
    "use_compression", "num_threads", "nodelet_manager", "service_type_retrieval_timeout_ms",
)  # fmt: skip
Patterns = Tuple[Pattern[str], ...]


def _are_patterns(value: Any) -> bool:
    try:
        return isinstance(value, list) and all(re.compile(pattern) for pattern in value)
    except (re.error, TypeError):
        return False


_PATTERNS = Allowed("a list of regular expressions, such as ['/odom', '/robot_.*']", _are_patterns,
                    lambda value: tuple(re.compile(pattern) for pattern in value))  # fmt: skip
_ALL = (re.compile(".*"),)
_WORDS = Allowed(
    f"a list of some of {', '.join(CAPABILITIES)}",
    lambda value: isinstance(value, list) and all(word in CAPABILITIES for word in value),
    tuple,
)
_ADDRESS = text("an address", lambda value: re.fullmatch(r"[\w.:-]+", value))
_NAME = text("a name of ROS", lambda value: re.fullmatch(r"[/~]?\w[\w/]*", value))
_IGNORED = "has no effect here"


@dataclass(frozen=True)
class BridgeParameters:
    """The parameters with their defaults; README.md has them as a table."""

    port: int = parameter(
        8765, whole_number(0, 65535, "a port, from 0 to 65535"), "of the WebSocket; 0: a free one"
    )
    address: str = parameter(
        "127.0.0.1", _ADDRESS, "to listen on; 0.0.0.0: for other machines, too"
    )
    tls: bool = parameter(False, switch, "true encrypts: `wss://`")
    certfile: str = parameter("", text("a file"), "the certificate in PEM for `tls`")
    keyfile: str = parameter("", text("a file"), "its private key in PEM")
    topic_whitelist: Patterns = parameter(_ALL, _PATTERNS, "topics that clients see", "`['.*']`")
    param_whitelist: Patterns = parameter(
        _ALL, _PATTERNS, "parameters that they see and set", "`['.*']`"
    )
    service_whitelist: Patterns = parameter(_ALL, _PATTERNS, "services that they call", "`['.*']`")
    client_topic_whitelist: Patterns = parameter(
        _ALL, _PATTERNS, "topics on which they publish", "`['.*']`"
    )
    capabilities: tuple[str, ...] = parameter(
        CAPABILITIES, _WORDS, "what clients may do; the two of parameters come together", "all"
    )
    asset_uri_allowlist: Patterns = parameter(
        (re.compile(ASSETS),), _PATTERNS, "files of packages that clients read", "models and images"
    )
    max_update_ms: int = parameter(
        5000, number(100, 3_600_000, "ms"), "between looks for new topics, at most 1000 here"
    )
    send_buffer_limit: int = parameter(
        10_000_000, whole_number(10_000), "bytes kept for a client that reads slowly"
    )
    use_compression: bool = parameter(False, switch, _IGNORED)
    num_threads: int = parameter(0, whole_number(0), _IGNORED)
    nodelet_manager: str = parameter("foxglove_nodelet_manager", _NAME, _IGNORED)
    service_type_retrieval_timeout_ms: int = parameter(250, whole_number(0), _IGNORED)


def parse_parameters(given: Mapping[str, Any]) -> BridgeParameters:
    """Return the checked parameters, with defaults filled in. Raises ValueError, one line."""
    parameters = BridgeParameters(**checked(BridgeParameters, given))
    if parameters.tls:
        for name in ("certfile", "keyfile"):
            if not getattr(parameters, name):
                raise ValueError(f"~{name}: '': must be a file where ~tls is true")
    return parameters


def ignored(parameters: BridgeParameters) -> list[str]:
    """Return a line for each parameter that has no effect here and is not at its default."""
    defaults = {name: field.default for name, field in declared(BridgeParameters).items()}
    values = {name: getattr(parameters, name) for name in WITHOUT_EFFECT}
    return [f"{name}: {v} {_IGNORED}" for name, v in values.items() if v != defaults[name]]


def is_allowed(name: str, patterns: Iterable[Pattern[str]]) -> bool:
    """Return whether a whitelist has a name, as a whole."""
    return any(pattern.fullmatch(name) for pattern in patterns)
