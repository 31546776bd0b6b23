"""Labels that an operator enters once for all records: run, operator, sample."""

from dataclasses import dataclass, fields
from typing import Self

MOST_LETTERS = 100  # of each


@dataclass(frozen=True, slots=True)
class RunLabels:
    """Three texts in the metadata of every playback and recording; "" is left out."""

    run: str = ""
    operator: str = ""
    sample: str = ""

    @classmethod
    def typed(cls, run: str, operator: str, sample: str) -> Self:
        """Return what someone typed, each as one line that a file's metadata can hold."""
        return cls(one_line(run), one_line(operator), one_line(sample))

    @property
    def metadata(self) -> dict[str, str]:
        """Those that are given, by their key."""
        named = {field.name: getattr(self, field.name) for field in fields(self)}
        return {key: text for key, text in named.items() if text}


def one_line(text: str, most: int = MOST_LETTERS) -> str:
    """Return a text without line ends, control characters, and blanks around; cut to ``most``."""
    shown = "".join(sign if sign.isprintable() else " " for sign in text)
    return " ".join(shown.split())[:most].strip()
