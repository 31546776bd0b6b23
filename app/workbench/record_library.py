"""The record library for the window, with its slow requests in the background."""

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from shutil import disk_usage

from PySide6.QtCore import QObject, Signal

from rotemina.app.language import format_file_size, translate
from rotemina.app.motion.playback import ComparedRun
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import RunLabels
from rotemina.app.records import LibraryEntry, RecordCatalogue
from rotemina.app.settings import UserSettings
from rotemina.app.workbench.background import BackgroundWorker
from rotemina.sim.errors import FileWriteError, describe_exception
from rotemina.sim.records import Record, write_record

# Preference: disk space for playbacks above which the operator is warned, and its default.
MAX_PLAYED_KEY, DEFAULT_MAX_PLAYED_GB = "records.bound_gb", 10
_RUN_KEY, _OPERATOR_KEY, _SAMPLE_KEY = "records.run", "records.operator", "records.sample"
# With less free space on the disk, the operator is warned.
_MIN_FREE_BYTES = 1_000_000_000
# Limits how long closing waits for a folder that does not respond.
_CLOSE_TIMEOUT_S = 2.0


class RecordLibrary(QObject):
    """All known records, and the operator's labels for new ones.

    Signals
    -------
    changed() : an entry was added, removed or renamed.
    labels_changed() : run, operator or sample has changed.
    """

    changed = Signal()
    labels_changed = Signal()

    def __init__(
        self,
        session: MotionSession,
        settings: UserSettings,
        played: Path,
        warn: Callable[[str], None],
    ) -> None:
        super().__init__()
        self.library = RecordCatalogue(played.parent, played)
        self._session, self._settings = session, settings
        self._warn = warn
        self._has_warned = False
        self._free_bytes: int | None = None
        self._background = BackgroundWorker(self)
        saved_texts = (settings.get(key, "") for key in (_RUN_KEY, _OPERATOR_KEY, _SAMPLE_KEY))
        session.labels = RunLabels.from_text(*saved_texts)

    @property
    def entries(self) -> tuple[LibraryEntry, ...]:
        """All records, newest first."""
        return self.library.entries

    @property
    def labels(self) -> RunLabels:
        """Run, operator and sample of new records."""
        return self._session.labels

    def use_labels(self, labels: RunLabels) -> None:
        """Set run, operator and sample of new records; they are saved for the next start."""
        if labels == self.labels:
            return
        self._session.labels = labels
        texts_by_key = {
            _RUN_KEY: labels.run,
            _OPERATOR_KEY: labels.operator,
            _SAMPLE_KEY: labels.sample,
        }
        for key, text in texts_by_key.items():
            self._settings.set(key, text)
        self.labels_changed.emit()

    def close(self) -> None:
        """Accept no more requests, and wait until everything is written."""
        self.library.close()
        self._background.end(_CLOSE_TIMEOUT_S)

    def refresh(self) -> None:
        """Read the current contents of the folders."""

        def read_folders() -> None:
            self.library.refresh()
            self._free_bytes = measure_free_bytes(self.library.playback_folder)

        self._run("refresh", read_folders)

    def make_path(self, name: str) -> Path:
        """Return the path for a new playback of that name."""
        stamp = datetime.now().strftime("%Y-%m-%d_%H-%M-%S-%f")
        stem = "".join(c if c.isalnum() or c in "-_" else "_" for c in Path(name).stem)[:40]
        return self.library.playback_folder / f"{stamp}_{stem}.csv.gz"

    def add(self, path: Path, record: Record, title: str) -> None:
        """Add a record that was written or opened."""
        self._run(f"add {path}", lambda: self.library.add(path, record, title))

    def set_gap(self, path: Path, run: ComparedRun) -> None:
        """Save the gap of a record of the library."""
        robot = self._session.robot
        self._run(f"gap of {path}", lambda: self.library.set_gap(path, run, robot))

    def set_texts(
        self, entry: LibraryEntry, *, name: str | None = None, note: str | None = None
    ) -> None:
        """Change the name, the note, or both of an entry."""
        self._run(
            f"call {entry.id}", lambda: self.library.set_texts(entry.id, name=name, note=note)
        )

    def set_path(self, entry: LibraryEntry, path: Path) -> None:
        """Set the current path of an entry's file."""
        self._run(f"found {entry.id}", lambda: self.library.set_path(entry.id, path))

    def delete(self, entries: tuple[LibraryEntry, ...]) -> None:
        """Delete records; those from other folders are only removed from the list."""
        entry_ids = frozenset(entry.id for entry in entries)
        self._run(f"delete {sorted(entry_ids)}", lambda: self.library.delete(entry_ids))

    def _run(self, kind: str, work: Callable[[], None]) -> None:
        def on_failed(reason: str) -> None:
            self._warn(reason)
            # A part of the work may have been done.
            self.changed.emit()

        self._background.run(kind, work, lambda _: self._on_done(), on_failed)

    def _on_done(self) -> None:
        self.changed.emit()
        if not self._has_warned and (warning := self._find_disk_space_warning()):
            self._has_warned = True
            self._warn(warning)

    def _find_disk_space_warning(self) -> str:
        played_bytes, max_gb = (
            self.library.playback_bytes,
            self._settings.get(MAX_PLAYED_KEY, DEFAULT_MAX_PLAYED_GB),
        )
        if played_bytes > 1e9 * max_gb:
            text = translate(
                "shell",
                "Playbacks occupy {size}, more than {most} GB (preference {key}). The "
                "program deletes none of them: delete unneeded ones in the panel Recorder.",
            )
            return text.format(size=format_file_size(played_bytes), most=max_gb, key=MAX_PLAYED_KEY)
        if self._free_bytes is not None and self._free_bytes < _MIN_FREE_BYTES:
            text = translate(
                "shell",
                "Only {free} are free on the disk of the records; playbacks occupy {size}. "
                "The program deletes none of them: delete unneeded ones in the panel "
                "Recorder.",
            )
            return text.format(
                free=format_file_size(self._free_bytes), size=format_file_size(played_bytes)
            )
        return ""


def write_playback(record: Record, path: Path) -> None:
    """Write the record of a playback; its folder is created if necessary.

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
                parent=path.parent, strerror=describe_exception(error)
            )
        ) from error
    write_record(record, path)


def measure_free_bytes(folder: Path) -> int | None:
    """Return the free space on the disk of a folder, which may not exist yet; None if unknown."""
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    try:
        return disk_usage(folder).free
    except OSError:
        return None
