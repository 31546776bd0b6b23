"""Sealed labels: a salted hash is published first, the label is opened and checked later."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rotemina.sim.errors import InputError


class SealError(InputError):
    """A label that is not the one that was sealed."""


@dataclass(frozen=True, slots=True)
class Seal:
    """SHA-256 of the salt (hex text) followed by the label; keeps the label from being changed."""

    digest: str

    def check(self, label: Mapping[str, Any] | bytes, salt: str, name: str) -> None:
        """Raise :class:`SealError` unless ``label`` and ``salt`` are what was sealed."""
        if seal(label, salt) != self:
            raise SealError(
                f"{name}: its label is not the one that was sealed before the diagnosis"
            )


def seal(label: Mapping[str, Any] | bytes, salt: str) -> Seal:
    """Seal a label (JSON, or the bytes of a file) with a salt."""
    text = label if isinstance(label, bytes) else canonical(label)
    return Seal(hashlib.sha256(salt.encode("utf-8") + text).hexdigest())


def canonical(value: Mapping[str, Any]) -> bytes:
    """Return JSON whose bytes depend on the value alone."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False).encode()


def digest(content: bytes) -> str:
    """Return the SHA-256 of an answer as it was written."""
    return hashlib.sha256(content).hexdigest()
