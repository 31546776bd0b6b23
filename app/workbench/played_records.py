"""Records of playbacks: each is stored when the playback ends, and compared with the model."""

from collections.abc import Callable, Hashable
from pathlib import Path
from typing import Protocol, TypeVar

from PySide6.QtCore import QObject, Signal

from rotemina.app.language import translate
from rotemina.app.motion.playback import ComparedRun, PlaybackPhase, compare_with_model
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import PlaybackFinished, SessionEvent
from rotemina.app.workbench.record_library import RecordLibrary, write_playback
from rotemina.sim.records import Record

Result = TypeVar("Result")


class BackgroundWork(Protocol):
    """Background work, as in :meth:`~rotemina.app.workbench.JobRunner.work`."""

    def __call__(
        self,
        kind: str,
        doing: str,
        work: Callable[[], Result],
        done: Callable[[Result], None],
        *,
        subject: Hashable | None = None,
    ) -> None:
        """Do the work and pass its result to ``done``."""


def make_save_subject(record: Record) -> Hashable:
    """Return the identity of notices about saving a played record, whatever the file."""
    return "keep", id(record)


class PlaybackRecords(QObject):
    """Storage of each played part of a trajectory, and its comparison with the model.

    Parameters
    ----------
    session : MotionSession
        Make this object before the playback, which subscribes to the session as well: an end must
        be counted before the playback reports it.
    library : RecordLibrary
    phase : callable
        Returns the phase of the playback.
    work : BackgroundWork

    Signals
    -------
    stored(Record) : the record is in a file of the library.
    compared(ComparedRun, Path) : a comparison to load, with the file of its record. After a pause
        it is emitted only when the playback has ended there.
    stopped_early(str) : a playback did not reach its end.
    """

    stored = Signal(object)
    compared = Signal(object, object)
    stopped_early = Signal(object)

    def __init__(
        self,
        session: MotionSession,
        library: RecordLibrary,
        phase: Callable[[], PlaybackPhase],
        work: BackgroundWork,
    ) -> None:
        super().__init__()
        self._session, self._library, self._phase, self._work = session, library, phase, work
        self._paused_run: tuple[ComparedRun, Path] | None = None
        # Ended playbacks: counted on the session's thread, and handled by the window.
        self._end_count = self._handled_count = 0
        # Closing ends the subscription, so that no more ends are counted.
        self.close = session.subscribe(self._count_end)

    @property
    def has_pending_end(self) -> bool:
        """Whether a playback has ended but is not handled yet."""
        return self._end_count != self._handled_count

    def take_playback(self, event: PlaybackFinished, name: str) -> None:
        """Store what was played and compare it with the model; call this on the window's thread."""
        self._handled_count += 1
        record, is_paused = event.record, self._phase() is PlaybackPhase.PAUSED
        if record is None:
            if not is_paused:
                text = translate("shell", "{name}: stopped before its first row was played.")
                self.stopped_early.emit(text.format(name=name))
            return
        # The record is stored first, so that neither a failed comparison nor the next run can lose
        # it.
        self._paused_run = None
        path = self._store(record, name)
        if not (event.completed or is_paused):
            text = translate("shell", "{name}: stopped after {duration_s:.2f} s.")
            self.stopped_early.emit(text.format(name=name, duration_s=record.duration_s))
        self._compare(event, record, name, path, paused=is_paused)

    def report_paused_run(self) -> None:
        """Report the run of the latest pause once the playback has ended there."""
        paused_run = self._paused_run
        # The order matters: an end is counted before the playback reports it.
        is_idle = paused_run is not None and self._phase() is PlaybackPhase.IDLE
        if paused_run is not None and is_idle and not self.has_pending_end:
            self._paused_run = None
            self.compared.emit(*paused_run)

    def _count_end(self, event: SessionEvent) -> None:
        if isinstance(event, PlaybackFinished) and event.shown:
            self._end_count += 1

    def _store(self, record: Record, name: str) -> Path:
        path = self._library.make_path(name)

        def on_stored(_: None) -> None:
            self.stored.emit(record)
            self._library.add(path, record, name)

        activity = translate("shell", "Storing {name} …").format(name=path.name)
        self._work(
            f"keep {path.name}",
            activity,
            lambda: write_playback(record, path),
            on_stored,
            subject=make_save_subject(record),
        )
        return path

    def _compare(
        self, event: PlaybackFinished, record: Record, name: str, path: Path, *, paused: bool
    ) -> None:
        def compare() -> ComparedRun:
            model = event.model or self._session.model
            completed, model_outputs = event.completed, event.model_outputs
            return compare_with_model(
                model, name, record, completed=completed, model_outputs=model_outputs
            )

        def on_compared(run: ComparedRun) -> None:
            self._library.set_gap(path, run)
            if paused and self._phase() is not PlaybackPhase.IDLE:
                self._paused_run = run, path
            else:
                self.compared.emit(run, path)

        # A separate kind for each file, so that every record gets its gap in the library.
        activity = translate("shell", "Comparing model and machine …")
        self._work(f"played {path.name}", activity, compare, on_compared)
