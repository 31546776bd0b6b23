"""The watchdog process; it runs as a single file with only the standard library.

It reads one line of JSON for each beat from standard input. If the program ends without a farewell,
or sends no beat for :data:`MAX_SILENCE_S`, it reports this on the terminal, in a log file, and in a
window if possible. After the program has ended in this way, the watchdog also writes the stop
command of the boards to each port that no other process has open.
"""

import contextlib
import json
import os
import queue
import subprocess
import sys
import threading
import time
from datetime import datetime
from pathlib import Path

MAX_SILENCE_S = 1.0
# Section "Stop" of docs/protocol.md.
STOP_MESSAGE = b"\0\0"
_WINDOW_PROGRAM = """
import sys, tkinter
root = tkinter.Tk()
root.title("RoTeMiNa")
root.attributes("-topmost", True)
tkinter.Label(root, text=sys.argv[1], font=("", 14), padx=30, pady=20, wraplength=600).pack()
tkinter.Button(root, text="OK", command=root.destroy).pack(pady=10)
root.mainloop()
"""


def find_problem(beat: dict[str, object], ages: dict[str, float], silence_s: float) -> str:
    """Return the problem, or "" if there is none.

    ``ages`` are the times in the latest beat since the last signs of life of window and worker, s.
    ``silence_s`` is the time since that beat.
    """
    if silence_s > MAX_SILENCE_S:
        return f"RoTeMiNa has hung for {silence_s:.0f} s."
    for name, subject in (
        ("window", "The window"),
        ("worker", "The thread that controls the machine"),
    ):
        age_s = ages.get(name)
        if age_s is not None and age_s > MAX_SILENCE_S:
            condition = " while the machine moves" if beat.get("moves") else ""
            return f"{subject} of RoTeMiNa does not answer{condition}."
    return ""


def stop_boards(ports: list[str]) -> list[str]:
    """Write the stop command to each port that can be opened; return a line about each port.

    Bit rate and format of the port stay as the program has set them.
    """
    outcomes = []
    for port in ports:
        try:
            flags = os.O_WRONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0)
            descriptor = os.open(port, flags)
        except OSError as error:
            outcomes.append(f"{port}: the stop could not be sent ({error.strerror})")
            continue
        try:
            os.write(descriptor, STOP_MESSAGE)
            outcomes.append(f"{port}: the stop was sent")
        except OSError as error:
            outcomes.append(f"{port}: the stop could not be sent ({error.strerror})")
        finally:
            os.close(descriptor)
    return outcomes


class Watchdog:
    """Receives beats, and reports each problem once, when it begins."""

    def __init__(self, log: Path, *, has_screen: bool) -> None:
        self._log, self._has_screen = log, has_screen
        self._beat: dict[str, object] = {}
        self._last_problem = ""
        self._window: subprocess.Popen[bytes] | None = None

    def receive_beat(self, line: str) -> bool:
        """Receive a beat; return False if it is the farewell of the program."""
        # If the program dies, the last line may be incomplete.
        with contextlib.suppress(ValueError):
            self._beat = json.loads(line)
        return not self._beat.get("farewell")

    def check(self, silence_s: float) -> None:
        """Report a problem if it is new; ``silence_s`` is the time since the last beat."""
        ages = {name: float(age) for name, age in self._get_ages().items()}
        problem = find_problem(self._beat, ages, silence_s)
        if problem and not self._last_problem:
            if self._beat.get("simulated"):
                self.report(problem, window=False)
            else:
                self.report(
                    f"{problem} The boards stop by their own watchdog. Look at the machine."
                )
        self._last_problem = problem

    def report_sudden_end(self) -> None:
        """Report that the program has ended unannounced, and stop the boards."""
        ports = self._beat.get("ports")
        outcomes = stop_boards([str(port) for port in ports] if isinstance(ports, list) else [])
        self.report(
            "\n".join(["RoTeMiNa has ended without disconnecting from the machine.", *outcomes])
        )

    def report(self, text: str, *, window: bool = True) -> None:
        """Print a text on the terminal, append it to the log, and show it in a window.

        Failures are ignored. Without ``window``, no window is shown. This is for
        problems with simulators, which need no immediate attention.
        """
        line = f"{datetime.now():%Y-%m-%d %H:%M:%S}  watchdog: {text}\n"
        with contextlib.suppress(OSError, ValueError):
            sys.stderr.write(line)
            sys.stderr.flush()
        with contextlib.suppress(OSError), self._log.open("a", encoding="utf-8") as log:
            log.write(line)
        if (
            self._has_screen
            and window
            and (self._window is None or self._window.poll() is not None)
        ):
            with contextlib.suppress(OSError):
                self._window = subprocess.Popen(
                    [sys.executable, "-c", _WINDOW_PROGRAM, text], stderr=subprocess.DEVNULL
                )

    def _get_ages(self) -> dict[str, float]:
        ages = self._beat.get("ages")
        return ages if isinstance(ages, dict) else {}


def main(arguments: list[str]) -> int:
    """Watch until the program ends.

    The arguments are the log file and, if a window may be shown, "screen".
    """
    watchdog = Watchdog(Path(arguments[0]), has_screen="screen" in arguments[1:])
    lines: queue.SimpleQueue[str] = queue.SimpleQueue()

    def read_lines() -> None:
        for line in sys.stdin:
            lines.put(line)
        lines.put("")

    threading.Thread(target=read_lines, daemon=True).start()
    last_beat_s = time.monotonic()
    while True:
        try:
            line = lines.get(timeout=0.25)
        except queue.Empty:
            watchdog.check(time.monotonic() - last_beat_s)
            continue
        last_beat_s = time.monotonic()
        if not line:
            watchdog.report_sudden_end()
            return 1
        if not watchdog.receive_beat(line):
            return 0
        watchdog.check(0.0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
