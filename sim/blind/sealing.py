"""Sealed labels: a salted hash is published first, and the label is checked against it later."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rotemina.sim.errors import SealError


@dataclass(frozen=True, slots=True)
class LabelSeal:
    """SHA-256 of the salt (hex text) and the label; it reveals any change of the label."""

    digest: str

    def check(self, label: Mapping[str, Any] | bytes, salt: str, name: str) -> None:
        """Raise :class:`SealError` unless ``label`` and ``salt`` are the sealed ones."""
        if seal_label(label, salt) != self:
            raise SealError(
                f"{name}: its label is not the one that was sealed before the diagnosis"
            )


def seal_label(label: Mapping[str, Any] | bytes, salt: str) -> LabelSeal:
    """Seal a label (JSON, or the bytes of a file) with a salt."""
    text = label if isinstance(label, bytes) else to_canonical_json(label)
    return LabelSeal(hashlib.sha256(salt.encode("utf-8") + text).hexdigest())


def to_canonical_json(value: Mapping[str, Any]) -> bytes:
    """Return JSON whose bytes depend only on the value."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False).encode()


def compute_digest(content: bytes) -> str:
    """Return the SHA-256 of the bytes of an answer."""
    return hashlib.sha256(content).hexdigest()
