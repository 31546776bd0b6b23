"""The records that a diagnosis may use, of the library and in hand; the ticked ones are used."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from rotemina.app.motion.compared_run import Run, compared, compared_again
from rotemina.app.records.entry import Entry, Kind
from rotemina.app.records.file_facts import moment
from rotemina.app.records.library import read, worst_gap
from rotemina.app.shell.background import Background
from rotemina.app.shell.column_mapping import ask_columns
from rotemina.app.shell.record_words import moment_text, worst_text
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.plugins.gap import tr
from rotemina.sim.errors import InputError
from rotemina.sim.quantities import NOTHING
from rotemina.sim.records.preview import preview
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot

MOST_UNTICKED = 20  # that are listed; older ones are found in the library


@dataclass(slots=True, eq=False)
class Listed:
    """A record of the list.

    Attributes
    ----------
    name : str
        As it was played or opened.
    record : Record, optional
        None: it is read as ``entry`` says when it is ticked.
    path : Path, optional
        Of the file that it was read from.
    entry : Entry, optional
        Of the library.
    ticked : bool
        Whether it is diagnosed.
    followed : bool
        Whether the next one that is played takes its tick.
    run : Run, optional
        What was said of it while it was played.
    gap : str
        Of the axis that departs most from the model in use, in noise floors.
    """

    name: str
    record: Record | None = None
    path: Path | None = None
    entry: Entry | None = None
    ticked: bool = True
    followed: bool = False
    run: Run | None = None
    gap: str = ""

    @property
    def title(self) -> str:
        """What it is called now."""
        return self.entry.name if self.entry else self.name

    @property
    def began(self) -> datetime | None:
        """When it was recorded."""
        if self.record is not None:
            return moment(self.record.metadata.get("began", ""))
        return self.entry.began if self.entry else None

    @property
    def full(self) -> str:
        """Its name with its time, by which a report tells it from others."""
        return ", ".join(filter(None, (self.title, moment_text(self.began))))

    def is_of(self, entry: Entry) -> bool:
        """Whether it is that record of the library."""
        if self.entry is not None:
            return self.entry.id == entry.id
        if self.path is not None:
            return self.path.absolute() == entry.path
        return self.began is not None and self.began == entry.began


class Records(QObject):
    """What is listed and what is ticked.

    Until something else is ticked, the tick follows the record that was played or opened last.

    Signals
    -------
    changed() : the list, a tick or a gap did.
    complete() : the files that were requested last are read, as far as they can be.
    """

    changed = Signal()
    complete = Signal()

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(parent)
        self._workbench, self._parent = workbench, parent
        self._robot: Robot = workbench.robot
        self._unread = 0  # of the files that were asked for last
        self._background = Background(self)  # a playback is compared before what is listed
        self._ended = False
        workbench.closing.connect(self._close)
        self.listed: list[Listed] = []
        self._list_kept()
        workbench.library.changed.connect(self._list_kept)
        workbench.run_changed.connect(self._follow)
        workbench.model_changed.connect(lambda _: self._work_out_gaps())
        if workbench.run is not None:
            self._follow(workbench.run)

    @property
    def chosen(self) -> tuple[Listed, ...]:
        """The records that are ticked and read, in the order in which they came."""
        return tuple(one for one in reversed(self.listed) if one.ticked and one.record is not None)

    def use_robot(self, robot: Robot) -> None:
        """Read further files with the axes and units of this robot."""
        self._robot = robot

    def add_files(self, paths: Sequence[Path]) -> None:
        """Read files and tick them as they come; one that cannot be read becomes a notice."""
        self._unread += len(paths)
        for path in paths:
            self._read(path, alone=len(paths) == 1)

    def add_entries(self, entries: Sequence[Entry]) -> None:
        """Read records of the library and tick them as they come."""
        self._unread += len(entries)
        for entry in entries:
            one = next((each for each in self.listed if each.is_of(entry)), None)
            if one is not None and one.record is not None:
                self._tick_beside(one)
                self._count_read()
            else:
                self._read_entry(one or Listed(entry.name, entry=entry, ticked=False), entry)

    def take(self, run: Run) -> None:
        """Tick the record that was played or opened."""
        self._tick_beside(self._of_run(run))

    def join(self, names: Sequence[str], records: Sequence[Record], run: Run) -> None:
        """Tick the records of an answer and the one that was played for it, and no others."""
        for one in self.listed:
            one.ticked = False
        for name, record in zip(names, records, strict=True):
            same = [one for one in self.listed if one.record is record]
            same.sort(key=lambda one: one.full != name)
            known = same[0] if same else self._add(Listed(name, record))
            known.ticked, known.followed = True, False
        self._tick_beside(self._of_run(run))

    def tick(self, one: Listed, *, ticked: bool) -> None:
        """Use a record, or leave it out; one that was kept before is read first."""
        if one.ticked is ticked:
            return
        if ticked and one.record is None and one.entry is not None:
            self._unread += 1
            self._read_entry(one, one.entry)
            return
        one.ticked, one.followed = ticked, False
        self.changed.emit()

    # --- the list ---------------------------------------------------------------------------------

    def _list_kept(self) -> None:
        """List the newest records of the library that can be read, and call all as it does."""
        library = self._workbench.library.entries
        known = {entry.id: entry for entry in library}
        for one in self.listed:
            if one.entry is not None:
                one.entry = known.get(one.entry.id, one.entry)
            else:
                one.entry = next((entry for entry in library if one.is_of(entry)), None)
        newest = [one for one in library if one.usable and one.kind is not Kind.RECORDING]
        for entry in newest[:MOST_UNTICKED]:
            if not any(one.is_of(entry) for one in self.listed):
                self.listed.append(Listed(entry.name, entry=entry, ticked=False))
        self._show_kept_gaps()
        self.changed.emit()

    def _show_kept_gaps(self) -> None:
        """Show the gaps that the library knows of the model in use."""
        model = self._workbench.session.model.id
        for one in self.listed:
            if one.record is None and one.entry is not None:
                same = one.entry.gap is not None and one.entry.model == model
                one.gap = worst_text(one.entry.gap) if same else ""

    def _add(self, one: Listed) -> Listed:
        self.listed.insert(0, one)
        unticked = [each for each in self.listed if not each.ticked and each is not one]
        for old in unticked[MOST_UNTICKED:]:
            self.listed.remove(old)
        self._work_out_gap(one)
        return one

    def _of_run(self, run: Run) -> Listed:
        same = (one for one in self.listed if one.record is run.record and one.name == run.name)
        one = next(same, None)
        if one is None:
            one = self._add(Listed(run.name, run.record, ticked=False, run=run))
        one.run, one.gap = run, worst_text(worst_gap(run, self._workbench.robot))
        return one

    def _follow(self, run: Run) -> None:
        one = self._of_run(run)
        ticked = [each for each in self.listed if each.ticked]
        if all(each.followed for each in ticked):
            for each in ticked:
                each.ticked = False
            one.ticked = one.followed = True
        self.changed.emit()

    def _tick_beside(self, one: Listed) -> None:
        """Tick a record by wish: what was ticked because it was the last one is so no longer."""
        for each in self.listed:
            each.ticked = each.ticked and not each.followed
        one.ticked, one.followed = True, False
        self.changed.emit()

    # --- gaps -------------------------------------------------------------------------------------

    def _work_out_gaps(self) -> None:
        self._show_kept_gaps()
        for one in self.listed:
            self._work_out_gap(one)
        self.changed.emit()

    def _work_out_gap(self, one: Listed) -> None:
        """Compare a record with the model in use, away from the window's thread."""
        record, run, bench = one.record, one.run, self._workbench
        if record is None:
            return
        model, memory = bench.session.model, bench.session.memory

        def work() -> str:
            if self._ended:
                return NOTHING
            try:
                if run is not None:
                    anew = compared_again(model, run, memory)
                else:
                    anew = compared(model, one.name, record)
                return worst_text(worst_gap(anew, bench.robot))
            except InputError:
                return NOTHING  # it is of another machine

        def done(gap: str) -> None:
            one.gap = gap
            self.changed.emit()

        self._background.run(f"gap of {id(one)}", work, done, lambda _: done(NOTHING))

    def _close(self) -> None:
        """Compare no further record, and wait for the one that is being compared."""
        self._ended = True
        self._background.end()

    # --- reading ----------------------------------------------------------------------------------

    def _read(self, path: Path, *, alone: bool) -> None:
        robot = self._robot

        def work() -> Record | None:
            return read_record(path, robot=robot) if preview(path).has_header else None

        def done(record: Record | None) -> None:
            if record is not None:
                self._workbench.library.add(path, record, path.name)
                self._tick_beside(self._add(Listed(path.name, record, path)))
            elif alone:
                ask_columns(path, self._workbench, self._parent.window(), self._read_named)
            else:
                self._workbench.notify(
                    Level.WARNING,
                    tr("{name}: no header; add this file alone to name its columns").format(
                        name=path.name
                    ),
                    about=self._parent,
                )
            self._count_read()

        self._workbench.read_file(f"gap record {path}", path.name, work, done, self._count_read)

    def _count_read(self) -> None:
        self._unread -= 1
        if self._unread == 0:
            self.complete.emit()

    def _read_named(self, path: Path, columns: str | None) -> None:
        robot = self._robot
        self._workbench.read_file(
            f"gap record {path}",
            path.name,
            lambda: read_record(path, columns=columns, robot=robot),
            lambda record: self._tick_beside(self._add(Listed(path.name, record, path))),
        )

    def _read_entry(self, one: Listed, entry: Entry) -> None:
        robot = self._robot

        def done(record: Record) -> None:
            one.record = record
            if one in self.listed:
                self._work_out_gap(one)
            else:
                self._add(one)
            self._tick_beside(one)
            self._count_read()

        def failed() -> None:
            self.changed.emit()  # its tick is taken back
            self._count_read()

        self._workbench.read_file(
            f"gap record {entry.path}", entry.name, lambda: read(entry, robot), done, failed
        )
