"""Starts the watchdog process, and sends it four beats a second."""

import json
import logging
import subprocess
import sys
from pathlib import Path

from rotemina.app.motion.device import Ticker
from rotemina.app.motion.session import BEAT_PERIOD_S, MotionSession
from rotemina.app.motion.state import ConnectionState
from rotemina.app.watchdog import process
from rotemina.drivers.contract import DeviceState, MachineKind

_LOG = logging.getLogger(__name__)
_REST_STATES = (DeviceState.CLOSED, DeviceState.IDLE, DeviceState.FAULT)


class HeartbeatSender:
    """Reports to the watchdog process that the program is alive.

    Parameters
    ----------
    session : MotionSession
    log : Path
        The file into which the watchdog writes its reports.
    screen : bool
        Whether the watchdog may show a window.
    """

    def __init__(self, session: MotionSession, log: Path, *, screen: bool) -> None:
        self._session = session
        self._arguments = [str(log), *(["screen"] if screen else [])]
        self._process: subprocess.Popen[str] | None = None
        #: Whether the window is still being made. While it is, and unless the machine moves, the
        #: window's thread may be busy for longer.
        self.starting = False
        self._ticker = Ticker("watchdog", BEAT_PERIOD_S, self.send_beat)

    @property
    def process_id(self) -> int | None:
        """The process id of the watchdog; None if it does not run."""
        return None if self._process is None else self._process.pid

    def start(self) -> None:
        """Start the process and the beats; a failure is logged, not raised."""
        try:
            Path(self._arguments[0]).parent.mkdir(parents=True, exist_ok=True)
            self._process = subprocess.Popen(
                [*_make_command(), *self._arguments],
                stdin=subprocess.PIPE,
                text=True,
                # A Ctrl-C that ends the program must not end its watchdog as well.
                start_new_session=True,
            )
        except OSError as error:
            _LOG.warning("the watchdog cannot be started: %s", error)
            return
        self._ticker.start()

    def send_beat(self) -> None:
        """Send a beat with the times since the last signs of life of the window and the worker."""
        session = self._session
        state, settings = session.snapshot(), session.driver.settings
        # The worker thread may be busy for a long time while it opens a device.
        is_connected = state.connection is ConnectionState.CONNECTED
        is_moving = state.activity not in _REST_STATES
        ages = {
            "window": session.screen_heartbeat.age_s if is_moving or not self.starting else None,
            "worker": session.pulse.age_s if is_connected else None,
        }
        ports = [str(port) for name, port in settings.items() if "port" in name and port]
        self._send(
            {
                "ages": {name: age_s for name, age_s in ages.items() if age_s is not None},
                "moves": is_moving,
                "simulated": session.driver.machine_kind is MachineKind.SIMULATED,
                "ports": ports if state.activity is not DeviceState.CLOSED else [],
            }
        )

    def close(self, timeout_s: float = 2.0) -> None:
        """Announce the end to the watchdog; safe to call twice."""
        self._ticker.close()
        watchdog = self._process
        if watchdog is None:
            return
        self._send({"farewell": True})
        self._process = None
        if watchdog.stdin is not None:
            watchdog.stdin.close()
        try:
            watchdog.wait(timeout_s)
        except subprocess.TimeoutExpired:
            watchdog.kill()
            watchdog.wait()

    def _send(self, beat: dict[str, object]) -> None:
        watchdog = self._process
        if watchdog is None or watchdog.stdin is None:
            return
        try:
            watchdog.stdin.write(json.dumps(beat) + "\n")
            watchdog.stdin.flush()
        except OSError:
            _LOG.warning("the watchdog has ended before the program")
            self._process = None


def _make_command() -> list[str]:
    """Return the command that starts the process.

    The executable of a bundle is not a Python interpreter, but it accepts ``-m`` like one.
    """
    if getattr(sys, "frozen", False):
        return [sys.executable, "-m", process.__name__]
    return [sys.executable, "-I", "-S", str(process.__file__)]
