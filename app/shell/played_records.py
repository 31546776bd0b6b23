"""The records of playbacks: stored as soon as a playback ends, and compared with the model."""

from collections.abc import Callable, Hashable
from pathlib import Path
from typing import Protocol, TypeVar

from PySide6.QtCore import QObject, Signal

from rotemina.app.motion.compared_run import Run, compared
from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Event, PlaybackFinished
from rotemina.app.shell.language import translate
from rotemina.app.shell.record_library import RecordLibrary, write_played
from rotemina.sim.records.record import Record

Answer = TypeVar("Answer")


class Work(Protocol):
    """Work in the background, as :meth:`~rotemina.app.shell.workbench.Workbench.work`."""

    def __call__(
        self,
        kind: str,
        doing: str,
        work: Callable[[], Answer],
        done: Callable[[Answer], None],
        *,
        subject: Hashable | None = None,
    ) -> None:
        """Do something and hand its answer on."""


def keeping(record: Record) -> Hashable:
    """Return what notices about writing a played record are known by, whichever file takes it."""
    return "keep", id(record)


class PlayedRecords(QObject):
    """Stores and compares each stretch that was played.

    Parameters
    ----------
    session : MotionSession
        Make this before the playback, which subscribes to the session, too: an end is counted
        before the playback says that it has ended.
    library : RecordLibrary
    phase : callable
        Return the phase of the playback.
    work : Work

    Signals
    -------
    stored(Record) : it is in a file of the library.
    compared(Run, Path) : to take in hand, with that file: at once, or for a pause when the playback
        has ended from there.
    told(str) : a playback did not reach its end.
    """

    stored = Signal(object)
    compared = Signal(object, object)
    told = Signal(object)

    def __init__(
        self,
        session: MotionSession,
        library: RecordLibrary,
        phase: Callable[[], PlaybackPhase],
        work: Work,
    ) -> None:
        super().__init__()
        self._session, self._library, self._phase, self._work = session, library, phase, work
        self._paused_run: tuple[Run, Path] | None = None
        self._ended = self._taken = 0  # playbacks: counted by the worker, and by the window
        self.close = session.subscribe(self._count)  # counts no further ends

    @property
    def untold(self) -> bool:
        """Whether a playback has ended that is yet to be taken."""
        return self._ended != self._taken

    def take(self, event: PlaybackFinished, name: str) -> None:
        """Store what was played and compare it with the model; on the window's thread."""
        self._taken += 1
        record, paused = event.record, self._phase() is PlaybackPhase.PAUSED
        if record is None:
            if not paused:
                text = translate("shell", "{name}: stopped before its first row was played.")
                self.told.emit(text.format(name=name))
            return
        # Stored before anything else: no comparison that fails, nor the next run, may lose it.
        self._paused_run = None
        path = self._store(record, name)
        if not (event.completed or paused):
            text = translate("shell", "{name}: stopped after {duration_s:.2f} s.")
            self.told.emit(text.format(name=name, duration_s=record.duration_s))
        self._compare(event, record, name, path, paused=paused)

    def look(self) -> None:
        """Hand over the run of the latest pause once the playback has ended from there."""
        held = self._paused_run
        # In this order: what has ended is counted before the playback says that it has.
        idle = held is not None and self._phase() is PlaybackPhase.IDLE
        if held is not None and idle and not self.untold:
            self._paused_run = None
            self.compared.emit(*held)

    def _count(self, event: Event) -> None:
        if isinstance(event, PlaybackFinished) and event.shown:
            self._ended += 1

    def _store(self, record: Record, name: str) -> Path:
        """Write a record into the folder of played records, and return where."""
        path = self._library.place(name)

        def done(_: None) -> None:
            self.stored.emit(record)
            self._library.add(path, record, name)

        storing = translate("shell", "Storing {name} …").format(name=path.name)
        self._work(
            f"keep {path.name}",
            storing,
            lambda: write_played(record, path),
            done,
            subject=keeping(record),
        )
        return path

    def _compare(
        self, event: PlaybackFinished, record: Record, name: str, path: Path, *, paused: bool
    ) -> None:
        def compare() -> Run:
            model = event.model or self._session.model
            completed, answers = event.completed, event.answers
            return compared(model, name, record, completed=completed, answers=answers)

        def done(run: Run) -> None:
            self._library.set_gap(path, run)
            if paused and self._phase() is not PlaybackPhase.IDLE:
                self._paused_run = run, path
            else:
                self.compared.emit(run, path)

        # A kind of its own: each stretch has its gap in the library, however soon the next ends.
        comparing = translate("shell", "Comparing model and machine …")
        self._work(f"played {path.name}", comparing, compare, done)
