"""The window on a display, until its user closes it."""

import atexit
import gc
import signal
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import pyqtgraph as pg
from platformdirs import user_data_path
from pyqtgraph.util.garbage_collector import GarbageCollector
from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QWidget

from rotemina.app.motion.heartbeat import PERIOD_S
from rotemina.app.motion.session import MotionSession
from rotemina.app.range_settings import kept_ranges
from rotemina.app.settings import Settings
from rotemina.app.shell import language
from rotemina.app.shell import theme as themes
from rotemina.app.shell.application import make_application
from rotemina.app.shell.exit_guard import TERMINATION_SIGNALS, exits_refused
from rotemina.app.shell.layouts import OPERATE
from rotemina.app.shell.main_window import MainWindow
from rotemina.app.shell.memory_allocator import give_back, trim_heap
from rotemina.app.shell.panel_watch import PanelWatch
from rotemina.app.shell.preloading import LATE, preload
from rotemina.app.shell.workbench import FRAME_MS, Level, Workbench
from rotemina.app.watchdog.heartbeat_sender import Watched
from rotemina.sim.errors import InputError

DEFAULT_THEME = "dark"
# How long another thread may go on once the window's, or the session's, wants to: both do so often.
SWITCH_S = 0.001
_GIVE_BACK_MS = 10_000  # between two times that free memory is given back


def make_window(
    session: MotionSession,
    settings: Settings,
    played_folder: Path | None = None,
    *,
    speaks: str | None = None,
) -> MainWindow:
    """Make the window with its workbench, in the language and theme last used; it is not shown yet.

    ``speaks`` takes the place of that language.

    Played records are kept in ``played_folder``, by default among the user's own data.
    """
    folder = played_folder or user_data_path("rotemina", appauthor=False) / "played"
    application = make_application()
    pg.setConfigOptions(antialias=False, useOpenGL=False)
    language.use(
        application, language.chosen(settings, speaks)
    )  # before anything is made that speaks
    theme = themes.theme_named(settings.get("window.theme", DEFAULT_THEME))
    themes.prepare(application, theme)
    window = MainWindow(Workbench(session, settings, theme, folder))
    _tell_of(settings, window.workbench)
    _narrow(session, settings, window.workbench)
    return window


def _narrow(session: MotionSession, settings: Settings, workbench: Workbench) -> None:
    """Use the ranges that were narrowed before; one that cannot be is told."""
    try:
        session.ranges.begin_with(kept_ranges(settings, session.robot))
    except InputError as error:
        text = language.translate(
            "shell", "No range is limited: {error}. Set the limits again in Control, Axes."
        ).format(error=error)
        workbench.notify(Level.WARNING, text, about="control.md")


def _tell_of(settings: Settings, workbench: Workbench) -> None:
    """Tell of preferences that could not be read, and where they are kept."""
    if settings.aside is not None:
        text = language.translate(
            "shell", "The preferences were reset: {fault}. The old file is kept as {path}."
        ).format(fault=settings.fault, path=settings.aside)
    elif settings.fault:
        text = language.translate(
            "shell",
            "The preferences were reset and cannot be saved: {fault}. Move that file away.",
        ).format(fault=settings.fault)
    else:
        return
    workbench.notify(Level.WARNING, text, about="window.md")


def tidy_memory(parent: QObject) -> Callable[[], None]:
    """Collect garbage and give free memory back now and then; return what ends that.

    Python's own collector runs on whatever thread happens to allocate, and what it frees on the
    session's thread may belong to Qt, which allows that on this one alone.
    """
    collector = GarbageCollector(interval=1.0)
    trimming = QTimer(parent, interval=_GIVE_BACK_MS)
    trimming.timeout.connect(give_back)
    trimming.start()

    def end() -> None:
        collector.timer.stop()
        trimming.stop()

    return end


def run(
    session: MotionSession,
    settings: Settings,
    *,
    speaks: str | None = None,
    splash: QWidget | None = None,
) -> int:
    """Show the window, in another language than the last where it is given, and run it.

    It takes the place of the splash screen. Return the exit status.
    """
    atexit.register(session.stop, "the program ends")  # also where a plugin's SystemExit ends it
    try:
        with exits_refused():
            return _run(session, settings, speaks, splash)
    except BaseException:
        session.stop("the program ends")
        raise
    finally:
        atexit.unregister(session.stop)


def _leave_on_signals(leave: Callable[[], None]) -> Sequence[int]:
    """Let each signal that asks for an end call ``leave``; return the numbers of those received."""
    received: list[int] = []

    def receive(number: int, _: object) -> None:
        received.append(number)
        # Not called here: a handler may interrupt anything, also a lock that closing needs.
        QTimer.singleShot(0, leave)

    for number in TERMINATION_SIGNALS:
        signal.signal(number, receive)
    return received


def _run(
    session: MotionSession, settings: Settings, speaks: str | None, splash: QWidget | None
) -> int:
    trim_heap()
    sys.setswitchinterval(SWITCH_S)
    application = make_application()

    def leave() -> None:
        window.workbench.stop()  # whoever sends a signal may not be there to be asked
        application.closeAllWindows()

    signals = _leave_on_signals(leave)
    window = make_window(session, settings, speaks=speaks)
    panels = window.panels
    watch = PanelWatch(
        window,
        panels,
        window.docks,
        window.workbench.notify,
        panels.kinds,
        window.reloading.remedy,
    )
    window.reloading.renewed.connect(watch.begin_with)
    watch.install()
    end_tidying = tidy_memory(application)
    with watch.guarding():
        window.show()
        if not settings.get("window.state", ""):  # a first start shows what is needed to begin
            window.arrangement.arrange(OPERATE)
        window.first_steps.offer()
    # A look through all that was imported takes tenths of a second, for which every thread waits:
    # longer than the boards' set-points last. What is here stays as long as the program.
    gc.freeze()
    window.late_panels.done.connect(gc.freeze)
    window.late_panels.load = lambda: preload((*LATE, *panels.modules_to_load))
    window.loop_watch.start()
    beat = QTimer(application, interval=round(1e3 * PERIOD_S))
    beat.timeout.connect(session.screen.beat)
    watched = Watched(
        session, user_data_path("rotemina", appauthor=False) / "watchdog.log", screen=True
    )
    window.workbench.closing.connect(beat.stop)
    window.workbench.closing.connect(session.screen.end)  # what closing waits for is no hang
    watched.starting = True

    def begin_use() -> None:
        watched.starting = False
        window.loop_watch.restart()

    window.late_panels.done.connect(begin_use)

    def connect() -> None:
        session.screen.beat()
        beat.start()
        watched.start()
        window.workbench.start()

    painted = QTimer(application, interval=FRAME_MS, singleShot=True)
    painted.timeout.connect(connect)  # what is seen is painted by then
    if splash is not None:
        painted.timeout.connect(splash.close)
    window.workbench.closing.connect(painted.stop)
    painted.start()
    # Python handles signals only between its own instructions: this wakes it now and then.
    wake = QTimer(application, interval=200)
    wake.timeout.connect(lambda: None)
    wake.start()
    status = application.exec()
    watched.close()
    watch.remove()
    end_tidying()
    return 128 + signals[-1] if signals else status
