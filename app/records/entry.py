"""One record of the library: its location, origin, name and note; and finding some by words."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum
from functools import cached_property
from pathlib import Path

NEW = 0  # the id of what is not in the library yet


class Kind(StrEnum):
    """Where a record comes from."""

    PLAYBACK = "playback"
    RECORDING = "recording"
    FILE = "file"  # opened from elsewhere


@dataclass(frozen=True, slots=True)
class WorstGap:
    """The gap of the axis that departs most from the model in use, rms in m or rad (``unit``)."""

    axis: str
    rms: float
    unit: str


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A record, of which the file may have gone or changed.

    Attributes
    ----------
    id : int
        The library's own; :data:`NEW` before it has one.
    path : Path
        Absolute.
    kind : Kind
    size, stamp : int
        Bytes, and time of the last change (ns), as they were looked at last.
    digest : str
        Tells its contents from others.
    began : datetime, optional
        When, with the offset of the place where it was recorded.
    duration_s : float, optional
        None where nobody knows.
    robot, machine, driver : str
        The robot's name, the digest of its file, and the driver.
    model : str
        Id of the model in use meanwhile.
    effects : str
        Those that were on, on a simulated machine.
    run, operator, sample : str
        As the operator set them.
    gap : WorstGap, optional
        From the model in use when it was recorded or first opened.
    events : int
        Of a recording: those that matter to someone who looks for what happened.
    name, note : str
        Which anyone may change.
    problem : str
        Why it cannot be opened; then nothing else is known.
    changed : bool
        Whether its contents have changed since it came into the library.
    missing : bool
        Whether there is no file at its place.
    """

    path: Path
    kind: Kind
    id: int = NEW
    size: int = 0
    stamp: int = 0
    digest: str = ""
    began: datetime | None = None
    duration_s: float | None = None
    robot: str = ""
    machine: str = ""
    driver: str = ""
    model: str = ""
    effects: str = ""
    run: str = ""
    operator: str = ""
    sample: str = ""
    gap: WorstGap | None = None
    events: int = 0
    name: str = ""
    note: str = ""
    problem: str = ""
    changed: bool = False
    missing: bool = False

    @property
    def usable(self) -> bool:
        """Whether its file is there and can be opened."""
        return not (self.missing or self.problem)

    @cached_property
    def age(self) -> tuple[float, str]:
        """What sorts the library: the time of the record, else that of its file."""
        at_s = self.stamp / 1e9 if self.began is None else self.began.timestamp()
        return at_s, self.path.name

    @cached_property
    def searched(self) -> str:
        """All that a search looks through, in small letters."""
        texts = (
            self.name,
            self.note,
            self.run,
            self.operator,
            self.sample,
            self.robot,
            self.driver,
            self.model,
            self.effects,
            self.path.name,
            f"{self.began.astimezone():%Y-%m-%d %H:%M:%S}" if self.began else "",
        )
        return "\n".join(texts).casefold()


def search(
    entries: Iterable[Entry], text: str = "", kinds: Collection[Kind] = frozenset(Kind)
) -> tuple[Entry, ...]:
    """Return the entries of some kinds that hold every word of a text, in their order.

    A word may stand anywhere in name, note, run, operator, sample, machine, driver, model,
    effects, date and file name; capital letters do not matter.
    """
    found = [one for one in entries if one.kind in kinds]
    for word in text.casefold().split():
        found = [one for one in found if word in one.searched]
    return tuple(found)
