"""An entry of the record library, and the search for entries by words."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum
from functools import cached_property
from pathlib import Path

#: Id of an entry that is not yet stored in the library.
NEW_ID = 0


class RecordKind(StrEnum):
    """Origin of a record; ``FILE`` is a file that was opened from another folder."""

    PLAYBACK = "playback"
    RECORDING = "recording"
    FILE = "file"


@dataclass(frozen=True, slots=True)
class WorstGap:
    """Gap of the axis that deviates most from the model in use; ``rms`` in ``unit``, m or rad."""

    axis: str
    rms: float
    unit: str


@dataclass(frozen=True, kw_only=True)
class LibraryEntry:
    """A record of the library; its file may have changed or disappeared since it was examined.

    Attributes
    ----------
    id : int
        Number in the library; :data:`NEW_ID` before the entry is stored.
    path : Path
        Absolute path of the file.
    kind : RecordKind
    size, stamp : int
        Size, bytes, and time of the last change, ns, when the file was last examined.
    digest : str
        Digest that identifies the contents of the file.
    began : datetime, optional
        Start of the record, with the UTC offset of the place where it was recorded.
    duration_s : float, optional
        None if it is unknown.
    robot, machine, driver : str
        Name of the robot, digest of its file, and name of the driver.
    model : str
        Id of the model that was in use.
    effects : str
        Active effects of a simulated machine.
    run, operator, sample : str
        Texts that the operator entered before the run.
    gap : WorstGap, optional
        Gap from the model in use when the record was made or first opened.
    events : int
        Number of important events of a recording.
    name, note : str
        Texts that the user may change.
    problem : str
        Why the file cannot be opened; then the facts above are unknown.
    changed : bool
        Whether the contents have changed since the record was added to the library.
    missing : bool
        Whether the file does not exist.
    """

    path: Path
    kind: RecordKind
    id: int = NEW_ID
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
    def is_usable(self) -> bool:
        """Whether the file exists and can be opened."""
        return not (self.missing or self.problem)

    @cached_property
    def sort_key(self) -> tuple[float, str]:
        """The start of the record, or else its file's modification time, s, and the file name."""
        time_s = self.stamp / 1e9 if self.began is None else self.began.timestamp()
        return time_s, self.path.name

    @cached_property
    def search_text(self) -> str:
        """All texts that a search examines, in lower case."""
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


def search_entries(
    entries: Iterable[LibraryEntry],
    text: str = "",
    kinds: Collection[RecordKind] = frozenset(RecordKind),
) -> tuple[LibraryEntry, ...]:
    """Return the entries of some kinds that contain every word of a text, in the given order.

    A word may occur anywhere in name, note, run, operator, sample, robot, driver, model, effects,
    date or file name. Upper and lower case are equivalent.
    """
    matches = [entry for entry in entries if entry.kind in kinds]
    for word in text.casefold().split():
        matches = [entry for entry in matches if word in entry.search_text]
    return tuple(matches)
