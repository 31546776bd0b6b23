"""The library of records for the window: its slow requests run in the background."""

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from shutil import disk_usage

from PySide6.QtCore import QObject, Signal

from rotemina.app.display_units import size_text
from rotemina.app.motion.compared_run import Run
from rotemina.app.motion.run_labels import RunLabels
from rotemina.app.motion.session import MotionSession
from rotemina.app.records.entry import Entry
from rotemina.app.records.library import Library
from rotemina.app.settings import Settings
from rotemina.app.shell.background import Background
from rotemina.app.shell.language import translate
from rotemina.sim.errors import reason_of
from rotemina.sim.records.record import Record
from rotemina.sim.records.writing import write_record
from rotemina.sim.whole_files import FileWriteError

BOUND_GB, MOST_GB = "records.bound_gb", 10  # the preference, and what it is at first
_RUN, _OPERATOR, _SAMPLE = "records.run", "records.operator", "records.sample"
_LEAST_FREE = 1_000_000_000  # bytes of the disk, below which its owner is told
_CLOSING_S = 2.0  # that closing waits for a look into a folder that hangs


class RecordLibrary(QObject):
    """What is known of all records, and what the operator says of those to come.

    Signals
    -------
    changed() : an entry has come, gone, or is called otherwise.
    labels_changed() : run, operator or sample.
    """

    changed = Signal()
    labels_changed = Signal()

    def __init__(
        self,
        session: MotionSession,
        settings: Settings,
        played: Path,
        told: Callable[[str], None],
    ) -> None:
        super().__init__()
        self.library = Library(played.parent, played)
        self._session, self._settings = session, settings
        self._told = told
        self._told_size = False
        self._free: int | None = None  # bytes of the disk
        self._background = Background(self)
        kept = (settings.get(key, "") for key in (_RUN, _OPERATOR, _SAMPLE))
        session.labels = RunLabels.typed(*kept)

    @property
    def entries(self) -> tuple[Entry, ...]:
        """All records, newest first."""
        return self.library.entries

    @property
    def labels(self) -> RunLabels:
        """Run, operator and sample of what is recorded from now on."""
        return self._session.labels

    def use_labels(self, labels: RunLabels) -> None:
        """Say run, operator and sample of what is recorded from now on; kept between starts."""
        if labels == self.labels:
            return
        self._session.labels = labels
        named = {_RUN: labels.run, _OPERATOR: labels.operator, _SAMPLE: labels.sample}
        for key, text in named.items():
            self._settings.set(key, text)
        self.labels_changed.emit()

    def close(self) -> None:
        """Begin nothing more, and wait for what is being written."""
        self.library.close()
        self._background.end(_CLOSING_S)

    # --- requests ---------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Look what there is now."""

        def look() -> None:
            self.library.refresh()
            self._free = free_bytes(self.library.played)

        self._run("refresh", look)

    def place(self, name: str) -> Path:
        """Return where a playback of that name is to be kept."""
        stamp = datetime.now().strftime("%Y-%m-%d_%H-%M-%S-%f")
        stem = "".join(c if c.isalnum() or c in "-_" else "_" for c in Path(name).stem)[:40]
        return self.library.played / f"{stamp}_{stem}.csv.gz"

    def add(self, path: Path, record: Record, title: str) -> None:
        """Take a record in that was written or opened."""
        self._run(f"add {path}", lambda: self.library.add(path, record, title))

    def set_gap(self, path: Path, run: Run) -> None:
        """Keep the gap of a record that was taken in."""
        robot = self._session.robot
        self._run(f"gap of {path}", lambda: self.library.set_gap(path, run, robot))

    def call(self, entry: Entry, *, name: str | None = None, note: str | None = None) -> None:
        """Give an entry another name, another note, or both."""
        self._run(f"call {entry.id}", lambda: self.library.call(entry.id, name=name, note=note))

    def found_at(self, entry: Entry, path: Path) -> None:
        """Say where the file of an entry is now."""
        self._run(f"found {entry.id}", lambda: self.library.found_at(entry.id, path))

    def delete(self, entries: tuple[Entry, ...]) -> None:
        """Delete records; those from elsewhere are only forgotten."""
        numbers = frozenset(one.id for one in entries)
        self._run(f"delete {sorted(numbers)}", lambda: self.library.delete(numbers))

    def _run(self, kind: str, work: Callable[[], None]) -> None:
        def failed(reason: str) -> None:
            self._told(reason)
            self.changed.emit()  # a part of it may be done

        self._background.run(kind, work, lambda _: self._done(), failed)

    def _done(self) -> None:
        self.changed.emit()
        if not self._told_size and (warning := self._too_large()):
            self._told_size = True
            self._told(warning)

    def _too_large(self) -> str:
        """Return what is to be said of the room that playbacks take; "" for nothing."""
        taken, most = self.library.played_bytes, self._settings.get(BOUND_GB, MOST_GB)
        if taken > 1e9 * most:
            text = translate(
                "shell",
                "Playbacks occupy {size}, more than {most} GB (preference {key}). The "
                "program deletes none of them: delete unneeded ones in the panel Recorder.",
            )
            return text.format(size=size_text(taken), most=most, key=BOUND_GB)
        if self._free is not None and self._free < _LEAST_FREE:
            text = translate(
                "shell",
                "Only {free} are free on the disk of the records; playbacks occupy {size}. "
                "The program deletes none of them: delete unneeded ones in the panel "
                "Recorder.",
            )
            return text.format(free=size_text(self._free), size=size_text(taken))
        return ""


def write_played(record: Record, path: Path) -> None:
    """Write a playback; its folder is made where there is none.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileWriteError(
            translate("shell", "{parent}: cannot be created: {strerror}").format(
                parent=path.parent, strerror=reason_of(error)
            )
        ) from error
    write_record(record, path)


def free_bytes(folder: Path) -> int | None:
    """Return how much room there is where a folder is, or will be; None if nobody knows."""
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    try:
        return disk_usage(folder).free
    except OSError:
        return None
