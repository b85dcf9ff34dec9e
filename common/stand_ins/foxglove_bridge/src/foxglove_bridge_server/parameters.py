"""The private parameters of the bridge, those of foxglove_bridge for ROS 1, and their checks."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Mapping, Tuple

from node_kit.parameters import declaration
from node_kit.parameters.declaration import Allowed, parameter, switch, text, whole_number

CAPABILITIES = (
    "clientPublish", "parameters", "parametersSubscribe", "services", "connectionGraph", "assets",
)  # fmt: skip
ASSETS = r"package://[-\w/]+\.(dae|glb|gltf|jpe?g|mtl|obj|png|stl|urdf)"
Patterns = Tuple[str, ...]


def _are_texts(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(pattern, str) for pattern in value)


def _compiled(patterns: list[str]) -> Patterns:
    for pattern in patterns:
        try:
            re.compile(pattern)
        except re.error as error:
            raise ValueError(f"{pattern!r} is not a regular expression: {error}") from None
    return tuple(patterns)


_PATTERNS = Allowed("a list of regular expressions", _are_texts, _compiled)
_WORDS = Allowed(
    f"a list of some of {', '.join(CAPABILITIES)}",
    lambda value: isinstance(value, list) and all(word in CAPABILITIES for word in value),
    tuple,
)
_ADDRESS = text("an address", lambda value: re.fullmatch(r"[\w.:-]+", value))
_NAME = text("a name of ROS", lambda value: re.fullmatch(r"[/~]?\w[\w/]*", value))
_FILE = text("a file in PEM, where `tls` is true")
_COUNT = whole_number(0, allowed="a whole number from 0")
_MS = whole_number(100, 3_600_000, "from 100 to 3600000")
_IGNORED = "has no effect here"


_ALL = (".*",)


@dataclass(frozen=True)
class BridgeParameters:
    """The parameters with their defaults; README.md has them as a table."""

    port: int = parameter(8765, whole_number(0, 65535, "a port; 0: a free one"), "of the WebSocket")
    address: str = parameter("127.0.0.1", _ADDRESS, "0.0.0.0: other machines connect, too")
    tls: bool = parameter(False, switch, "true encrypts: `wss://`")
    certfile: str = parameter("", _FILE, "the certificate")
    keyfile: str = parameter("", _FILE, "its private key")
    topic_whitelist: Patterns = parameter(_ALL, _PATTERNS, "topics that clients see", "all")
    param_whitelist: Patterns = parameter(_ALL, _PATTERNS, "parameters they see and set", "all")
    service_whitelist: Patterns = parameter(_ALL, _PATTERNS, "services that they call", "all")
    client_topic_whitelist: Patterns = parameter(_ALL, _PATTERNS, "topics they publish", "all")
    asset_uri_allowlist: Patterns = parameter(
        (ASSETS,), _PATTERNS, "files of packages that they read", "models and images"
    )
    capabilities: tuple[str, ...] = parameter(CAPABILITIES, _WORDS, "what they may do", "all")
    max_update_ms: int = parameter(5000, _MS, "between two looks for topics; at most 1000 here")
    send_buffer_limit: int = parameter(
        10_000_000,
        whole_number(10_000, allowed="from 10000"),
        "bytes kept for a client that reads slowly",
    )
    use_compression: bool = parameter(False, switch, _IGNORED)
    num_threads: int = parameter(0, _COUNT, _IGNORED)
    nodelet_manager: str = parameter("foxglove_nodelet_manager", _NAME, _IGNORED)
    service_type_retrieval_timeout_ms: int = parameter(250, _COUNT, _IGNORED)

    def ignored(self) -> list[str]:
        """Return a line for each parameter that was set and has no effect here."""
        return [
            f"{name}: {getattr(self, name)} {_IGNORED}"
            for name, field in declaration.declared(BridgeParameters).items()
            if field.metadata["meaning"] == _IGNORED and getattr(self, name) != field.default
        ]


def parse_parameters(given: Mapping[str, Any]) -> BridgeParameters:
    """Return the checked parameters, with defaults filled in. Raises ValueError, one line."""
    return BridgeParameters(**declaration.checked(BridgeParameters, given))


def is_allowed(name: str, patterns: Patterns) -> bool:
    """Return whether a whitelist has a name, as a whole."""
    return any(re.fullmatch(pattern, name) for pattern in patterns)
