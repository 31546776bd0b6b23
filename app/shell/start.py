"""Starting the window: what the machine lacks is said in one line before Qt would abort."""

import gc
import logging
import os
import signal
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from rotemina.app.driver_settings import assigned, kept
from rotemina.app.motion.session import MotionSession
from rotemina.app.settings import Settings
from rotemina.app.shell.display_check import display_fault
from rotemina.app.shell.exit_guard import TERMINATION_SIGNALS
from rotemina.app.system_check import complaint, missing_libraries, platform_in_use
from rotemina.drivers.driver import Driver
from rotemina.drivers.registry import driver_named
from rotemina.drivers.settings import SettingError, SettingValue
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import Robot

logger = logging.getLogger(__name__)


def start(
    robot: str,
    *,
    driver: str,
    assignments: Sequence[str],
    offscreen: bool,
    output: Path,
    speaks: str | None = None,
) -> int:
    """Open the window and run it until it is closed; return the exit status.

    Parameters
    ----------
    robot : name of a shipped robot, or a robot file.
    driver : name of an installed driver.
    assignments : settings of the driver, each as ``name=value``.
    offscreen : do the main job without a display.
    output : folder for the picture and report of a run without a display.
    speaks : language of the window, in place of the one last used.

    Raises
    ------
    InputError
        If the robot cannot be loaded, there is no such driver, or it cannot take a setting.
    """
    logging.basicConfig(level=logging.WARNING, format="%(levelname)s %(name)s: %(message)s")
    described = load_robot(robot)
    kind = driver_named(driver)
    given = assigned(kind, assignments)
    reason = "--offscreen" if offscreen else display_fault()
    if reason:
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    missing = missing_libraries(platform_in_use(os.environ))
    if missing:
        print(f"rotemina: {complaint(missing)}", file=sys.stderr)
        return 1

    if reason:
        with _signals_end_at_once():
            _load_qt()
            from rotemina.app.shell import offscreen_run

            session = MotionSession(kind(described, given))
        print(f"No window ({reason}): doing the main job offscreen instead.")
        return offscreen_run.run(session, output)
    gc.disable()  # what is loaded stays: looks through it take a tenth of a start
    with _signals_end_at_once():
        _load_qt()
        from rotemina.app.shell.application import show_splash

        splash = show_splash()
        from rotemina.app.shell import window_run

        settings = Settings()
        session = MotionSession(_driver(kind, described, given, settings))
    return window_run.run(session, settings, speaks=speaks, splash=splash)


def _load_qt() -> None:
    from rotemina.app.shell import qt_imports, qt_messages  # Qt may be loaded from here on

    qt_imports.spare_source_search()
    qt_messages.log_qt_messages()


@contextmanager
def _signals_end_at_once() -> Iterator[None]:
    """Let a signal end the process while nothing is open yet.

    Qt's binding aborts if an exception, such as that of Ctrl-C, interrupts its import.
    """
    handlers = {number: signal.signal(number, signal.SIG_DFL) for number in TERMINATION_SIGNALS}
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


def _driver(
    kind: type[Driver], robot: Robot, given: Mapping[str, SettingValue], settings: Settings
) -> Driver:
    """Make a driver with the settings that were given, and for the rest those used last."""
    try:
        return kind(robot, {**kept(settings, kind), **given})
    except SettingError as error:
        logger.warning("kept settings of driver %s are ignored: %s", kind.name, error)
        return kind(robot, given)  # a bad preference keeps no window shut; what was given does
