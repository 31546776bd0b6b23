"""Records of the window: opened, played and recorded ones, the compared run, and replays."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from rotemina.app.language import translate
from rotemina.app.motion.model import ModelInUse
from rotemina.app.motion.playback import ComparedRun, compare_run_again, compare_with_model
from rotemina.app.motion.recording import Replay
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import PlaybackFinished
from rotemina.app.operation import OperatorControl
from rotemina.app.records import LibraryEntry, read_entry
from rotemina.app.workbench.job_runner import JobRunner
from rotemina.app.workbench.notice_poster import Level, NoticePoster
from rotemina.app.workbench.operator_requests import OperatorRequests
from rotemina.app.workbench.penetration_records import PenetrationRecorder
from rotemina.app.workbench.played_records import PlaybackRecords, make_save_subject
from rotemina.app.workbench.progress_line import WorkProgress
from rotemina.app.workbench.record_library import RecordLibrary
from rotemina.app.workbench.recording_replay import ReplayControl, find_mismatch, open_recording
from rotemina.sim.records import Record, read_record, write_record


class RecordManager(QObject):
    """Manager of the records that the window shows, compares and saves.

    Attributes
    ----------
    run : ComparedRun or None
        The latest comparison.
    run_path : Path or None
        The file of its record.
    record : Record or None
        The record that would be saved.
    unsaved : Record or None
        A played record that is not yet in a file. Each playback is written into the library's
        folder automatically when it ends.
    replaying : ReplayControl

    Signals
    -------
    run_changed(ComparedRun) : a record was opened or a playback ended, and it is compared with the
        model.
    """

    run_changed = Signal(object)

    def __init__(
        self,
        requests: OperatorRequests,
        library: RecordLibrary,
        playback_records: PlaybackRecords,
        operation: OperatorControl,
        jobs: JobRunner,
        notices: NoticePoster,
    ) -> None:
        super().__init__(requests)
        self.run: ComparedRun | None = None
        self.run_path: Path | None = None
        self.record: Record | None = None
        self.unsaved: Record | None = None
        self._session, self._robot = requests.session, requests.robot
        self._requests, self._library, self._operation = requests, library, operation
        self._jobs, self._notices = jobs, notices
        self._playback_records = playback_records
        playback_records.stored.connect(self._note_saved)
        playback_records.compared.connect(self.take_run)
        playback_records.stopped_early.connect(
            lambda text: notices.notify(Level.WARNING, text, about="trajectory.md")
        )
        self._penetration_recorder = PenetrationRecorder(operation, notices.warn_from_any_thread)
        self._penetration_recorder.stored.connect(lambda _: library.refresh())
        self.replaying = ReplayControl(requests.session, operation.penetration)

    @property
    def source(self) -> MotionSession | Replay:
        """The machine or the replay that is shown; ``replaying.changed`` reports a change."""
        paced = self.replaying.paced
        return self._session if paced is None else paced.replay

    @property
    def has_unhandled_playback(self) -> bool:
        """Whether a playback has ended that the window has not handled yet."""
        return self._playback_records.has_pending_end

    def close(self) -> None:
        """Take no more playbacks, and wait until the recording of a penetration is written."""
        self._playback_records.close()
        self._penetration_recorder.close()

    def update(self) -> None:
        """Report and record what the machine has done; to be called in every frame."""
        self._playback_records.report_paused_run()
        self._penetration_recorder.update_recording()

    def open_record(self, path: Path, columns: str | None = None) -> None:
        """Read a record as "real", compare it with the model, and add it to the library."""

        def work() -> ComparedRun:
            record = read_record(path, columns=columns, robot=self._robot)
            return compare_with_model(self._session.model, path.name, record)

        def done(run: ComparedRun) -> None:
            # A file without a header could not be opened again without asking for its columns.
            if columns is None:
                self._library.add(path, run.record, path.name)
            self._take_library_run(run, path)

        self._jobs.read_file("run", path.name, work, done)

    def open_entry(self, entry: LibraryEntry) -> None:
        """Compare a record of the library with the model, as :meth:`open_record` does."""

        def work() -> ComparedRun:
            return compare_with_model(
                self._session.model, entry.name, read_entry(entry, self._robot)
            )

        self._jobs.read_file(
            "run", entry.name, work, lambda run: self._take_library_run(run, entry.path)
        )

    def save_record(self, path: Path) -> None:
        """Write the loaded record to a file; it counts as unsaved until that is done."""
        record = self.record
        if record is None:
            text = translate("shell", "There is no record to save: play or open one first.")
            self._notices.notify(
                Level.WARNING,
                text,
                about="comparison.md",
                until=lambda _: self.record is not None,
            )
            return

        self._jobs.write_file(
            "save", path, lambda: write_record(record, path), lambda: self._note_saved(record)
        )

    def open_replay(self, path: Path) -> None:
        """Show a recording instead of the machine."""

        def show(replay: Replay) -> None:
            warning = find_mismatch(replay, self._robot)
            if (
                self._requests.run_request(lambda: self.replaying.show(replay))
                and warning is not None
            ):
                self._notices.notify(Level.WARNING, warning, about=replay)

        activity = translate("shell", "Opening {name} …").format(name=path.name)
        self._jobs.work("replay", activity, lambda: open_recording(path, self._robot), show)

    def finish_recording(self, done: Callable[[], None], undone: Callable[[], None]) -> None:
        """End the running recording and write everything, in the background.

        ``done`` is called when nothing is left to wait for, ``undone`` after a failure.
        """

        def work(_: WorkProgress) -> None:
            if self._operation.recording is not None:
                self._operation.stop_recording()

        progress = WorkProgress(
            translate("shell", "The recording is being merged into one file."), cancellable=False
        )
        self._jobs.long_work("last recording", progress, work, lambda _: done(), undone)

    def take_run(self, run: ComparedRun, path: Path | None = None) -> None:
        """Make a comparison the loaded one; ``path`` is the file of its record, if there is one."""
        self.run, self.run_path = run, path
        self.record = run.record
        self.run_changed.emit(run)

    def take_playback(self, event: PlaybackFinished, name: str) -> None:
        """Store the record of a playback under a name, and compare it with the model."""
        if event.record is not None:
            self.record = self.unsaved = event.record
        self._playback_records.take_playback(event, name)

    def compare_again(self, model: ModelInUse) -> None:
        """Compare the record of the run with another model."""
        run = self.run
        if run is None:
            return
        self._jobs.work(
            "run again",
            translate("shell", "Comparing model and machine …"),
            lambda: compare_run_again(model, run, self._session.memory),
            self._renew_run,
            renews=True,
        )

    def _take_library_run(self, run: ComparedRun, path: Path) -> None:
        self._library.set_gap(path, run)
        self.take_run(run, path.absolute())

    def _renew_run(self, run: ComparedRun) -> None:
        """Replace the comparison by one of the same record with another model."""
        if self.run is not None and self.run.record is run.record:
            self.take_run(run, self.run_path)

    def _note_saved(self, record: Record) -> None:
        if self.unsaved is record:
            self.unsaved = None
        self._notices.settled.emit(make_save_subject(record))
