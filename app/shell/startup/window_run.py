"""Running the window on a display until the user closes it."""

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

from rotemina.app.language import language
from rotemina.app.motion.session import BEAT_PERIOD_S, MotionSession, load_ranges
from rotemina.app.settings import UserSettings
from rotemina.app.shell.panels import PanelWatch
from rotemina.app.shell.startup.application import make_application
from rotemina.app.shell.startup.exit_guard import TERMINATION_SIGNALS, refuse_exits
from rotemina.app.shell.startup.memory_allocator import configure_allocator, release_free_memory
from rotemina.app.shell.startup.preloading import LATE_MODULES, preload
from rotemina.app.shell.window import OPERATE, MainWindow
from rotemina.app.watchdog import HeartbeatSender
from rotemina.app.widgets.style import theme as themes
from rotemina.app.workbench import (
    FRAME_MS,
    Level,
    Workbench,
)
from rotemina.sim.errors import InputError

DEFAULT_THEME = "dark"
# Time after which Python switches to another thread. Both the window's and the session's thread
# need the interpreter often.
THREAD_SWITCH_S = 0.001
_MEMORY_RELEASE_MS = 10_000


def make_window(
    session: MotionSession,
    settings: UserSettings,
    played_folder: Path | None = None,
    *,
    ui_language: str | None = None,
) -> MainWindow:
    """Create the window and its workbench in the saved language and theme, without showing it.

    ``ui_language`` replaces the saved language. Played records are saved in ``played_folder``, by
    default among the user's own data.
    """
    folder = played_folder or user_data_path("rotemina", appauthor=False) / "played"
    application = make_application()
    pg.setConfigOptions(antialias=False, useOpenGL=False)
    # The language must be set before any text is created.
    language.use_language(application, language.determine_language(settings, ui_language))
    theme = themes.find_theme(settings.get("window.theme", DEFAULT_THEME))
    themes.apply_palette(application, theme)
    window = MainWindow(Workbench(session, settings, theme, folder))
    _report_settings_fault(settings, window.workbench)
    _restore_ranges(session, settings, window.workbench)
    return window


def _restore_ranges(session: MotionSession, settings: UserSettings, workbench: Workbench) -> None:
    try:
        session.ranges.set_initial_ranges(load_ranges(settings, session.robot))
    except InputError as error:
        text = language.translate(
            "shell", "No range is limited: {error}. Set the limits again in Control, Axes."
        ).format(error=error)
        workbench.notify(Level.WARNING, text, about="control.md")


def _report_settings_fault(settings: UserSettings, workbench: Workbench) -> None:
    if settings.damaged_copy is not None:
        text = language.translate(
            "shell", "The preferences were reset: {fault}. The old file is kept as {path}."
        ).format(fault=settings.load_error, path=settings.damaged_copy)
    elif settings.load_error:
        text = language.translate(
            "shell",
            "The preferences were reset and cannot be saved: {fault}. Move that file away.",
        ).format(fault=settings.load_error)
    else:
        return
    workbench.notify(Level.WARNING, text, about="window.md")


def start_memory_upkeep(parent: QObject) -> Callable[[], None]:
    """Collect garbage and release free memory regularly; return a function that ends this.

    Python's own collector runs on any thread that allocates. What it frees on the session's thread
    may belong to Qt, whose objects may only be freed on this thread.
    """
    collector = GarbageCollector(interval=1.0)
    release_timer = QTimer(parent, interval=_MEMORY_RELEASE_MS)
    release_timer.timeout.connect(release_free_memory)
    release_timer.start()

    def end() -> None:
        collector.timer.stop()
        release_timer.stop()

    return end


def run(
    session: MotionSession,
    settings: UserSettings,
    *,
    ui_language: str | None = None,
    splash: QWidget | None = None,
) -> int:
    """Show and run the window, in place of the splash screen; return the exit status.

    ``ui_language`` replaces the saved language.
    """
    # Also stops the machine if SystemExit in a plugin ends the program.
    atexit.register(session.stop, "the program ends")
    try:
        with refuse_exits():
            return _run(session, settings, ui_language, splash)
    except BaseException:
        session.stop("the program ends")
        raise
    finally:
        atexit.unregister(session.stop)


def _close_on_signals(close_window: Callable[[], None]) -> Sequence[int]:
    """Call ``close_window`` on each termination signal; return a list of the received signals."""
    received: list[int] = []

    def receive(number: int, _: object) -> None:
        received.append(number)
        # Delayed, because a handler may interrupt code that holds a mutex that closing needs.
        QTimer.singleShot(0, close_window)

    for number in TERMINATION_SIGNALS:
        signal.signal(number, receive)
    return received


def _make_closable_window(
    session: MotionSession, settings: UserSettings, ui_language: str | None
) -> tuple[MainWindow, Sequence[int]]:
    """Return a window that a termination signal closes, and a list of the received signals."""
    windows: list[MainWindow] = []

    def close_window() -> None:
        # Stopped first, because otherwise closing would ask a question that nobody may be there to
        # answer.
        for window in windows:
            window.workbench.stop()
            make_application().closeAllWindows()

    signals = _close_on_signals(close_window)
    windows.append(make_window(session, settings, ui_language=ui_language))
    if signals:
        # A panel may have handled events while the window was made, so that it was not closed.
        QTimer.singleShot(0, close_window)
    return windows[0], signals


def _run(
    session: MotionSession, settings: UserSettings, ui_language: str | None, splash: QWidget | None
) -> int:
    configure_allocator()
    sys.setswitchinterval(THREAD_SWITCH_S)
    application = make_application()

    window, signals = _make_closable_window(session, settings, ui_language)
    panels = window.panels
    watch = PanelWatch(
        window,
        panels,
        window.docks,
        window.workbench.notify,
        panels.panel_types,
    )
    watch.install()
    end_memory_upkeep = start_memory_upkeep(application)
    with watch.guard():
        window.show()
        # The first start has no saved layout.
        if not settings.get("window.state", ""):
            window.arrangement.arrange(OPERATE)
        window.first_steps.offer()
    # A garbage collection over all imported modules would take tenths of a second and block every
    # thread: longer than the boards' set-points last. Frozen objects are not scanned.
    gc.freeze()
    window.panel_loader.done.connect(gc.freeze)
    window.panel_loader.start_loading = lambda: preload((*LATE_MODULES, *panels.modules_to_load))
    window.loop_watch.start()
    heartbeat_timer = QTimer(application, interval=round(1e3 * BEAT_PERIOD_S))
    heartbeat_timer.timeout.connect(session.screen_heartbeat.beat)
    heartbeat_sender = HeartbeatSender(
        session, user_data_path("rotemina", appauthor=False) / "watchdog.log", screen=True
    )
    window.workbench.closing.connect(heartbeat_timer.stop)
    # Waiting during closing is not a hang.
    window.workbench.closing.connect(session.screen_heartbeat.end)
    heartbeat_sender.starting = True

    def begin_use() -> None:
        heartbeat_sender.starting = False
        window.loop_watch.restart()

    window.panel_loader.done.connect(begin_use)

    def connect() -> None:
        session.screen_heartbeat.beat()
        heartbeat_timer.start()
        heartbeat_sender.start()
        window.workbench.start()

    first_frame_timer = QTimer(application, interval=FRAME_MS, singleShot=True)
    # Everything visible is painted by then.
    first_frame_timer.timeout.connect(connect)
    if splash is not None:
        first_frame_timer.timeout.connect(splash.close)
    window.workbench.closing.connect(first_frame_timer.stop)
    first_frame_timer.start()
    # Python handles signals only between its own instructions, so this timer makes it run some.
    signal_timer = QTimer(application, interval=200)
    signal_timer.timeout.connect(lambda: None)
    signal_timer.start()
    status = application.exec()
    heartbeat_sender.close()
    watch.remove()
    end_memory_upkeep()
    return 128 + signals[-1] if signals else status
