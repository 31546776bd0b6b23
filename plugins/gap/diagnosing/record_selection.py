"""Records of the library and of this session. The ticked ones are diagnosed."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from rotemina.app.motion.playback import (
    ComparedRun,
    compare_run_again,
    compare_with_model,
)
from rotemina.app.records import LibraryEntry, RecordKind, find_worst_gap, parse_time, read_entry
from rotemina.app.shell.records import ask_columns, format_moment, format_worst_gap
from rotemina.app.workbench import BackgroundWorker, Level, Workbench
from rotemina.plugins.gap import tr
from rotemina.sim.errors import InputError
from rotemina.sim.messages import NO_VALUE
from rotemina.sim.records import Record, read_preview, read_record
from rotemina.sim.robot import Robot

# The list drops older records that are not ticked. They can still be found in the library.
MAX_UNTICKED_RECORDS = 20


@dataclass(slots=True, eq=False)
class ListedRecord:
    """Record of the list.

    Attributes
    ----------
    name : str
        Name under which the record was played or opened.
    record : Record, optional
        None until it is read from ``entry``, which happens when it is ticked.
    path : Path, optional
        File from which it was read.
    entry : LibraryEntry, optional
        Its entry in the library.
    ticked : bool
        Whether it is diagnosed.
    is_auto_ticked : bool
        Whether it was ticked only because it was the latest. It then loses its tick to the next
        record.
    run : ComparedRun, optional
        The run that recorded it, with the comparison made then.
    gap : str
        Gap from the model in use, as text, for the axis with the largest gap in noise floors.
    """

    name: str
    record: Record | None = None
    path: Path | None = None
    entry: LibraryEntry | None = None
    ticked: bool = True
    is_auto_ticked: bool = False
    run: ComparedRun | None = None
    gap: str = ""

    @property
    def title(self) -> str:
        """Current name, which the library may have changed."""
        return self.entry.name if self.entry else self.name

    @property
    def began(self) -> datetime | None:
        """Time at which the recording began."""
        if self.record is not None:
            return parse_time(self.record.metadata.get("began", ""))
        return self.entry.began if self.entry else None

    @property
    def full_name(self) -> str:
        """Name with the time of recording, which is unique in a report."""
        return ", ".join(filter(None, (self.title, format_moment(self.began))))

    def is_same_as(self, entry: LibraryEntry) -> bool:
        """Return whether this is the record of a library entry."""
        if self.entry is not None:
            return self.entry.id == entry.id
        if self.path is not None:
            return self.path.absolute() == entry.path
        return self.began is not None and self.began == entry.began


class RecordSelection(QObject):
    """List of records and their ticks.

    Until the operator ticks a record, the latest record that was played or opened is ticked.

    Signals
    -------
    changed() : the list, a tick or a gap changed.
    reading_finished() : all requested files have been read or have failed.
    """

    changed = Signal()
    reading_finished = Signal()

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(parent)
        self._workbench, self._parent = workbench, parent
        self._robot: Robot = workbench.robot
        # Number of requested files that have not been read yet.
        self._pending_read_count = 0
        # Comparisons run on a separate thread, so that the workbench never waits for them.
        self._background = BackgroundWorker(self)
        self._is_closed = False
        workbench.closing.connect(self._close)
        self.listed: list[ListedRecord] = []
        self._list_library()
        workbench.library.changed.connect(self._list_library)
        workbench.run_changed.connect(self._on_run)
        workbench.model_changed.connect(lambda _: self._compute_gaps())
        if workbench.run is not None:
            self._on_run(workbench.run)

    @property
    def chosen(self) -> tuple[ListedRecord, ...]:
        """Records that are ticked and have been read, from the end of the list to its start."""
        return tuple(
            listed
            for listed in reversed(self.listed)
            if listed.ticked and listed.record is not None
        )

    def use_robot(self, robot: Robot) -> None:
        """Use the axes and units of this robot for files that are read from now on."""
        self._robot = robot

    def add_files(self, paths: Sequence[Path]) -> None:
        """Read files, and tick each one when it has been read. A failure is shown as a notice."""
        self._pending_read_count += len(paths)
        for path in paths:
            self._read_file(path, is_only_file=len(paths) == 1)

    def add_entries(self, entries: Sequence[LibraryEntry]) -> None:
        """Read records of the library, and tick each one when it has been read."""
        self._pending_read_count += len(entries)
        for entry in entries:
            listed = next((other for other in self.listed if other.is_same_as(entry)), None)
            if listed is not None and listed.record is not None:
                self._tick_on_request(listed)
                self._count_down_reads()
            else:
                self._read_entry(
                    listed or ListedRecord(entry.name, entry=entry, ticked=False), entry
                )

    def tick_run(self, run: ComparedRun) -> None:
        """Tick the record that was played or opened."""
        self._tick_on_request(self._find_or_add_run(run))

    def tick_with_run(
        self, names: Sequence[str], records: Sequence[Record], run: ComparedRun
    ) -> None:
        """Tick the records of an answer and the record of a run, and no others."""
        for other in self.listed:
            other.ticked = False
        for name, record in zip(names, records, strict=True):
            matches = [other for other in self.listed if other.record is record]
            matches.sort(key=lambda other: other.full_name != name)
            listed = matches[0] if matches else self._add(ListedRecord(name, record))
            listed.ticked, listed.is_auto_ticked = True, False
        self._tick_on_request(self._find_or_add_run(run))

    def tick(self, record: ListedRecord, *, ticked: bool) -> None:
        """Tick or untick a record. A record that is only in the library is read first."""
        if record.ticked is ticked:
            return
        if ticked and record.record is None and record.entry is not None:
            self._pending_read_count += 1
            self._read_entry(record, record.entry)
            return
        record.ticked, record.is_auto_ticked = ticked, False
        self.changed.emit()

    def _list_library(self) -> None:
        """List the newest usable records of the library, and use its names for all records."""
        entries = self._workbench.library.entries
        entries_by_id = {entry.id: entry for entry in entries}
        for listed in self.listed:
            if listed.entry is not None:
                listed.entry = entries_by_id.get(listed.entry.id, listed.entry)
            else:
                listed.entry = next((entry for entry in entries if listed.is_same_as(entry)), None)
        newest = [
            entry for entry in entries if entry.is_usable and entry.kind is not RecordKind.RECORDING
        ]
        for entry in newest[:MAX_UNTICKED_RECORDS]:
            if not any(listed.is_same_as(entry) for listed in self.listed):
                self.listed.append(ListedRecord(entry.name, entry=entry, ticked=False))
        self._show_library_gaps()
        self.changed.emit()

    def _show_library_gaps(self) -> None:
        """Show the gaps that the library has stored, if they are gaps from the model in use."""
        model_id = self._workbench.session.model.id
        for listed in self.listed:
            if listed.record is None and listed.entry is not None:
                has_gap = listed.entry.gap is not None and listed.entry.model == model_id
                listed.gap = format_worst_gap(listed.entry.gap) if has_gap else ""

    def _add(self, listed: ListedRecord) -> ListedRecord:
        self.listed.insert(0, listed)
        unticked = [other for other in self.listed if not other.ticked and other is not listed]
        for dropped in unticked[MAX_UNTICKED_RECORDS:]:
            self.listed.remove(dropped)
        self._compute_gap(listed)
        return listed

    def _find_or_add_run(self, run: ComparedRun) -> ListedRecord:
        matches = (
            listed
            for listed in self.listed
            if listed.record is run.record and listed.name == run.name
        )
        listed = next(matches, None)
        if listed is None:
            listed = self._add(ListedRecord(run.name, run.record, ticked=False, run=run))
        listed.run, listed.gap = run, format_worst_gap(find_worst_gap(run, self._workbench.robot))
        return listed

    def _on_run(self, run: ComparedRun) -> None:
        listed = self._find_or_add_run(run)
        ticked_records = [other for other in self.listed if other.ticked]
        if all(other.is_auto_ticked for other in ticked_records):
            for other in ticked_records:
                other.ticked = False
            listed.ticked = listed.is_auto_ticked = True
        self.changed.emit()

    def _tick_on_request(self, listed: ListedRecord) -> None:
        """Tick a record on request, and untick records that were ticked automatically."""
        for other in self.listed:
            other.ticked = other.ticked and not other.is_auto_ticked
        listed.ticked, listed.is_auto_ticked = True, False
        self.changed.emit()

    def _compute_gaps(self) -> None:
        self._show_library_gaps()
        for listed in self.listed:
            self._compute_gap(listed)
        self.changed.emit()

    def _compute_gap(self, listed: ListedRecord) -> None:
        record, run, workbench = listed.record, listed.run, self._workbench
        if record is None:
            return
        model, memory = workbench.session.model, workbench.session.memory

        def compare() -> str:
            if self._is_closed:
                return NO_VALUE
            try:
                if run is not None:
                    comparison = compare_run_again(model, run, memory)
                else:
                    comparison = compare_with_model(model, listed.name, record)
                return format_worst_gap(find_worst_gap(comparison, workbench.robot))
            except InputError:
                # The record belongs to another machine.
                return NO_VALUE

        def on_done(gap: str) -> None:
            listed.gap = gap
            self.changed.emit()

        self._background.run(f"gap of {id(listed)}", compare, on_done, lambda _: on_done(NO_VALUE))

    def _close(self) -> None:
        """Skip the remaining comparisons, and wait for the running one."""
        self._is_closed = True
        self._background.end()

    def _read_file(self, path: Path, *, is_only_file: bool) -> None:
        robot = self._robot

        def read_if_has_header() -> Record | None:
            return read_record(path, robot=robot) if read_preview(path).has_header else None

        def on_read(record: Record | None) -> None:
            if record is not None:
                self._workbench.library.add(path, record, path.name)
                self._tick_on_request(self._add(ListedRecord(path.name, record, path)))
            elif is_only_file:
                # The file counts as read only when the operator has named its columns.
                ask_columns(
                    path,
                    self._workbench,
                    self._parent.window(),
                    self._read_with_columns,
                    self._count_down_reads,
                )
                return
            else:
                self._workbench.notify(
                    Level.WARNING,
                    tr("{name}: no header; add this file alone to name its columns").format(
                        name=path.name
                    ),
                    about=self._parent,
                )
            self._count_down_reads()

        self._workbench.read_file(
            f"gap record {path}", path.name, read_if_has_header, on_read, self._count_down_reads
        )

    def _count_down_reads(self) -> None:
        self._pending_read_count -= 1
        if self._pending_read_count == 0:
            self.reading_finished.emit()

    def _read_with_columns(self, path: Path, columns: str | None) -> None:
        robot = self._robot

        def on_read(record: Record) -> None:
            self._tick_on_request(self._add(ListedRecord(path.name, record, path)))
            self._count_down_reads()

        self._workbench.read_file(
            f"gap record {path}",
            path.name,
            lambda: read_record(path, columns=columns, robot=robot),
            on_read,
            self._count_down_reads,
        )

    def _read_entry(self, listed: ListedRecord, entry: LibraryEntry) -> None:
        robot = self._robot

        def on_read(record: Record) -> None:
            listed.record = record
            if listed in self.listed:
                self._compute_gap(listed)
            else:
                self._add(listed)
            self._tick_on_request(listed)
            self._count_down_reads()

        def on_failure() -> None:
            # This makes the views remove the tick that the operator has set.
            self.changed.emit()
            self._count_down_reads()

        self._workbench.read_file(
            f"gap record {entry.path}",
            entry.name,
            lambda: read_entry(entry, robot),
            on_read,
            on_failure,
        )
