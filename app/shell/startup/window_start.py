"""Start-up of the window, with a one-line report of missing libraries before Qt would abort."""

import gc
import logging
import os
import signal
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from rotemina.app.motion.session import MotionSession
from rotemina.app.settings import UserSettings, load_settings, parse_assignments
from rotemina.app.shell.startup.display_check import find_display_fault
from rotemina.app.shell.startup.exit_guard import TERMINATION_SIGNALS
from rotemina.app.system import (
    describe_missing,
    find_missing_libraries,
    find_platform,
)
from rotemina.drivers.contract import Driver, DriverSettingError, SettingValue, find_driver
from rotemina.sim.robot import Robot
from rotemina.sim.robot_files import load_robot

logger = logging.getLogger(__name__)


def start(
    robot: str,
    *,
    driver: str,
    assignments: Sequence[str],
    offscreen: bool,
    output: Path,
    ui_language: str | None = None,
) -> int:
    """Open the window and run it until it is closed; return the exit status.

    Parameters
    ----------
    robot : str
        Name of a shipped robot, or path of a robot file.
    driver : str
        Name of an installed driver.
    assignments : sequence of str
        Settings of the driver, each as ``name=value``.
    offscreen : bool
        Do the main job without a display.
    output : Path
        Folder for the picture and report of a run without a display.
    ui_language : str, optional
        Language of the window, instead of the saved one.

    Raises
    ------
    InputError
        If the robot cannot be loaded, there is no such driver, or it does not accept a setting.
    """
    logging.basicConfig(level=logging.WARNING, format="%(levelname)s %(name)s: %(message)s")
    robot_model = load_robot(robot)
    driver_class = find_driver(driver)
    driver_settings = parse_assignments(driver_class, assignments)
    reason = "--offscreen" if offscreen else find_display_fault()
    if reason:
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    missing_libraries = find_missing_libraries(find_platform(os.environ))
    if missing_libraries:
        print(f"rotemina: {describe_missing(missing_libraries)}", file=sys.stderr)
        return 1

    if reason:
        with _use_default_signal_handlers():
            _load_qt()
            from rotemina.app.shell.startup import offscreen_run

            session = MotionSession(driver_class(robot_model, driver_settings))
        print(f"No window ({reason}): doing the main job offscreen instead.")
        return offscreen_run.run(session, output)
    # Loaded modules are not garbage, and looking for it would take a tenth of the start-up time.
    gc.disable()
    with _use_default_signal_handlers():
        _load_qt()
        from rotemina.app.shell.startup.application import show_splash

        splash = show_splash()
        from rotemina.app.shell.startup import window_run

        settings = UserSettings()
        session = MotionSession(_make_driver(driver_class, robot_model, driver_settings, settings))
    return window_run.run(session, settings, ui_language=ui_language, splash=splash)


def _load_qt() -> None:
    # Imported here, because importing Qt is only safe from now on.
    from rotemina.app.shell.startup.qt_setup import log_qt_messages, skip_source_search

    skip_source_search()
    log_qt_messages()


@contextmanager
def _use_default_signal_handlers() -> Iterator[None]:
    """Let a signal end the process at once while nothing is open yet.

    Qt's binding aborts if an exception, such as that of Ctrl-C, interrupts its import.
    """
    handlers = {number: signal.signal(number, signal.SIG_DFL) for number in TERMINATION_SIGNALS}
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


def _make_driver(
    driver_class: type[Driver],
    robot: Robot,
    driver_settings: Mapping[str, SettingValue],
    settings: UserSettings,
) -> Driver:
    """Create a driver with the given settings; the saved ones complete them."""
    try:
        return driver_class(robot, {**load_settings(settings, driver_class), **driver_settings})
    except DriverSettingError as error:
        logger.warning("kept settings of driver %s are ignored: %s", driver_class.name, error)
        # A bad saved setting must not prevent the window from opening; a bad given one must.
        return driver_class(robot, driver_settings)
