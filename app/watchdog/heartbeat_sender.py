"""The program's side of its watchdog: starts the process, and sends it four beats a second."""

import json
import logging
import subprocess
import sys
from pathlib import Path

from rotemina.app.motion.heartbeat import PERIOD_S
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection
from rotemina.app.motion.ticker import Ticker
from rotemina.app.watchdog import process
from rotemina.drivers.driver import MachineKind
from rotemina.drivers.samples import DeviceState

_LOG = logging.getLogger(__name__)
_AT_REST = (DeviceState.CLOSED, DeviceState.IDLE, DeviceState.FAULT)


class Watched:
    """Reports to a separate process that the program is alive.

    Parameters
    ----------
    session : MotionSession
    log : Path
        Where the watchdog writes what it tells.
    screen : bool
        Whether it may show a window.
    """

    def __init__(self, session: MotionSession, log: Path, *, screen: bool) -> None:
        self._session = session
        self._arguments = [str(log), *(["screen"] if screen else [])]
        self._process: subprocess.Popen[str] | None = None
        #: Whether the window is still being made: it may take its time while nothing moves.
        self.starting = False
        self._ticker = Ticker("watchdog", PERIOD_S, self.beat)

    @property
    def number(self) -> int | None:
        """The number of the watchdog's process; None where there is none."""
        return None if self._process is None else self._process.pid

    def start(self) -> None:
        """Start the process and begin to beat; where it cannot be, that is logged."""
        try:
            Path(self._arguments[0]).parent.mkdir(parents=True, exist_ok=True)
            self._process = subprocess.Popen(
                [*_command(), *self._arguments],
                stdin=subprocess.PIPE,
                text=True,
                start_new_session=True,  # a Ctrl-C that ends the program must not end its watchdog
            )
        except OSError as error:
            _LOG.warning("there is no watchdog beside the program: %s", error)
            return
        self._ticker.start()

    def beat(self) -> None:
        """Send a beat with the state of the window and the worker."""
        session = self._session
        state, settings = session.snapshot(), session.driver.settings
        connected = state.connection is Connection.CONNECTED  # opening a device may take long
        moves = state.activity not in _AT_REST
        ages = {
            "window": session.screen.age_s if moves or not self.starting else None,
            "worker": session.pulse.age_s if connected else None,
        }
        ports = [str(port) for name, port in settings.items() if "port" in name and port]
        self._say(
            {
                "ages": {name: age_s for name, age_s in ages.items() if age_s is not None},
                "moves": moves,
                "simulated": session.driver.machine_kind is MachineKind.SIMULATED,
                "ports": ports if state.activity is not DeviceState.CLOSED else [],
            }
        )

    def close(self, timeout_s: float = 2.0) -> None:
        """Say farewell; safe to call twice."""
        self._ticker.close()
        running = self._process
        if running is None:
            return
        self._say({"farewell": True})
        self._process = None
        if running.stdin is not None:
            running.stdin.close()
        try:
            running.wait(timeout_s)
        except subprocess.TimeoutExpired:
            running.kill()
            running.wait()

    def _say(self, beat: dict[str, object]) -> None:
        running = self._process
        if running is None or running.stdin is None:
            return
        try:
            running.stdin.write(json.dumps(beat) + "\n")
            running.stdin.flush()
        except OSError:
            _LOG.warning("the watchdog beside the program has ended")
            self._process = None


def _command() -> list[str]:
    """Return what starts the process: a bundle is no Python, but answers to ``-m`` as one does."""
    if getattr(sys, "frozen", False):
        return [sys.executable, "-m", process.__name__]
    return [sys.executable, "-I", "-S", str(process.__file__)]
