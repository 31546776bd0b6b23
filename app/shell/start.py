"""Starting the window: what the machine lacks is said in one line before Qt would abort."""

import logging
import os
import sys
from pathlib import Path

from rotemina.app.motion.session import MotionSession
from rotemina.app.settings import Settings
from rotemina.app.shell.display import display_fault
from rotemina.app.system_check import complaint, missing_libraries, platform_in_use
from rotemina.drivers.registry import driver_named
from rotemina.sim.robot.file import load_robot

logger = logging.getLogger(__name__)


def start(robot: str, *, driver: str, offscreen: bool, output: Path) -> int:
    """Open the window and run it until it is closed; return the exit status.

    Parameters
    ----------
    robot : name of a shipped robot, or a robot file.
    driver : name of an installed driver.
    offscreen : do the main job without a display.
    output : folder for the picture and report of a run without a display.

    Raises
    ------
    InputError
        If the robot cannot be loaded or there is no such driver.
    """
    logging.basicConfig(level=logging.WARNING, format="%(levelname)s %(name)s: %(message)s")
    described = load_robot(robot)
    make_driver = driver_named(driver)
    reason = "--offscreen" if offscreen else display_fault()
    if reason:
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    missing = missing_libraries(platform_in_use(os.environ))
    if missing:
        print(f"rotemina: {complaint(missing)}", file=sys.stderr)
        return 1

    from rotemina.app.shell import qt_messages  # Qt may be loaded from here on

    qt_messages.log_qt_messages()
    session = MotionSession(make_driver(described))
    if not reason:
        from rotemina.app.shell import window_run

        return window_run.run(session, Settings())
    from rotemina.app.shell import offscreen_run

    print(f"No window ({reason}): playing the example trajectory offscreen instead.")
    return offscreen_run.run(session, output)
