"""Work in the background for the window: its notices, its progress and its pending result."""

from collections.abc import Callable, Hashable
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, Signal

from rotemina.app.language import translate
from rotemina.app.workbench.background import BackgroundWorker
from rotemina.app.workbench.notice_poster import Level, NoticePoster
from rotemina.app.workbench.progress_line import WorkProgress

Result = TypeVar("Result")


class JobRunner(QObject):
    """Runner of slow work, one piece at a time; failures become notices.

    Attributes
    ----------
    progress : WorkProgress or None
        Long work in progress, see :meth:`long_work`.

    Signals
    -------
    busy_changed(str) : the work in the background, or "".
    """

    busy_changed = Signal(str)

    def __init__(self, notices: NoticePoster) -> None:
        super().__init__(notices)
        self.progress: WorkProgress | None = None
        self._notices = notices
        self._background = BackgroundWorker(self)

    @property
    def busy(self) -> bool:
        """Whether work in the background is in progress."""
        return self._background.busy

    def close(self) -> None:
        """Discard all pending results and wait until no work is running."""
        self._background.end()

    def work(
        self,
        kind: str,
        doing: str,
        work: Callable[[], Result],
        done: Callable[[Result], None],
        undone: Callable[[], None] = lambda: None,
        *,
        replaced: Callable[[], None] | None = None,
        renews: bool = False,
        subject: Hashable | None = None,
    ) -> None:
        """Do work in the background and pass its result to ``done``; a failure becomes a notice.

        If several requests of one ``kind`` are pending, only the latest result is used. When the
        work is done, the notice of an earlier failure of the same ``subject`` (by default the kind)
        is removed. ``doing`` is shown meanwhile, and ``undone`` is called after a failure. If a
        later request of the same kind replaces this one, ``replaced`` is called. Without
        ``replaced``, a notice reports that, unless the work only ``renews`` an earlier result, for
        example while a number is typed.
        """
        notice_subject = kind if subject is None else subject

        def on_finished(result: Result) -> None:
            self.busy_changed.emit("")
            self._notices.settled.emit(notice_subject)
            done(result)

        def on_failed(message: str) -> None:
            self.busy_changed.emit("")
            self._notices.notify(Level.ERROR, message, subject=notice_subject)
            undone()

        def report_replaced() -> None:
            if not renews:
                text = translate("shell", "Replaced by a newer request: {doing}")
                self._notices.notify(Level.INFO, text.format(doing=doing))
            undone()

        self.busy_changed.emit(doing)
        self._background.run(kind, work, on_finished, on_failed, replaced or report_replaced)

    def read_file(
        self,
        kind: str,
        name: object,
        read: Callable[[], Result],
        done: Callable[[Result], None],
        undone: Callable[[], None] = lambda: None,
    ) -> None:
        """Read a file of this name in the background, as :meth:`work` does."""
        doing = translate("shell", "Reading {name} …").format(name=name)
        self.work(kind, doing, read, done, undone)

    def write_file(
        self,
        kind: str,
        path: Path,
        write: Callable[[], object],
        saved: Callable[[], None] = lambda: None,
    ) -> None:
        """Write a file in the background, as :meth:`work` does; report it and call ``saved``."""

        def done(_: object) -> None:
            self._notices.notify(Level.GOOD, translate("shell", "Saved {path}").format(path=path))
            saved()

        doing = translate("shell", "Writing {name} …").format(name=path.name)
        # Each path is a separate kind, so that every file is reported.
        self.work(f"{kind} {path}", doing, write, done)

    def long_work(
        self,
        kind: str,
        progress: WorkProgress,
        work: Callable[[WorkProgress], Result],
        done: Callable[[Result], None],
        undone: Callable[[], None] = lambda: None,
    ) -> None:
        """Do long work in the background, as :meth:`work` does; the window shows its progress.

        ``work`` reports to the progress that it receives. It ends when a report raises because the
        operator has cancelled it.
        """

        def on_finished(result: Result) -> None:
            self._end_progress(progress)
            self._notices.settled.emit(kind)
            done(result)

        def on_failed(message: str) -> None:
            self._end_progress(progress)
            level = Level.INFO if progress.cancelled else Level.ERROR
            self._notices.notify(level, message, subject=kind)
            undone()

        self.progress = progress
        self._background.run(kind, lambda: work(progress), on_finished, on_failed, undone)

    def run_quietly(
        self,
        kind: str,
        work: Callable[[], Result],
        done: Callable[[Result], None],
        failed: Callable[[str], None],
    ) -> None:
        """Do short work without showing it; the message of a failure is passed to ``failed``."""
        self._background.run(kind, work, done, failed)

    def _end_progress(self, progress: WorkProgress) -> None:
        if self.progress is progress:
            self.progress = None
