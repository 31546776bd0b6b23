"""The watchdog process; it runs as a single file with only the standard library.

It reads one line of JSON for each beat from standard input. The program's end without a farewell,
or :data:`SILENT_S` without a beat, is told on the terminal, in a log file, and in a window where
one can be shown. After an end it writes the boards' stop to every port that nobody else has open.
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

SILENT_S = 1.0
STOP = b"\0\0"  # docs/protocol.md, "Stop"
_WINDOW = """
import sys, tkinter
root = tkinter.Tk()
root.title("RoTeMiNa")
root.attributes("-topmost", True)
tkinter.Label(root, text=sys.argv[1], font=("", 14), padx=30, pady=20, wraplength=600).pack()
tkinter.Button(root, text="OK", command=root.destroy).pack(pady=10)
root.mainloop()
"""


def verdict(beat: dict[str, object], ages: dict[str, float], silence_s: float) -> str:
    """Return the problem by the latest beat and the ages since, or ""."""
    if silence_s > SILENT_S:
        return f"RoTeMiNa has hung for {silence_s:.0f} s."
    for name, what in (("window", "The window"), ("worker", "The thread that steers the machine")):
        age_s = ages.get(name)
        if age_s is not None and age_s > SILENT_S:
            moves = " while the machine moves" if beat.get("moves") else ""
            return f"{what} of RoTeMiNa does not answer{moves}."
    return ""


def stop_boards(ports: list[str]) -> list[str]:
    """Write the stop to each available port; return the outcomes.

    Line speed and format stay as the program has set them.
    """
    told = []
    for port in ports:
        try:
            flags = os.O_WRONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0)
            line = os.open(port, flags)
        except OSError as error:
            told.append(f"{port}: the stop could not be sent ({error.strerror})")
            continue
        try:
            os.write(line, STOP)
            told.append(f"{port}: the stop was sent")
        except OSError as error:
            told.append(f"{port}: the stop could not be sent ({error.strerror})")
        finally:
            os.close(line)
    return told


class Watchdog:
    """Receives beats, and reports each problem once when it begins."""

    def __init__(self, log: Path, *, shown: bool) -> None:
        self._log, self._shown = log, shown
        self._beat: dict[str, object] = {}
        self._told = ""
        self._window: subprocess.Popen[bytes] | None = None

    def take(self, line: str) -> bool:
        """Take a beat; return whether the program continues, and has not said farewell."""
        with contextlib.suppress(ValueError):  # cut off in mid-line
            self._beat = json.loads(line)
        return not self._beat.get("farewell")

    def look(self, silence_s: float) -> None:
        """Report a new problem."""
        ages = {name: float(age) for name, age in self._ages().items()}
        wrong = verdict(self._beat, ages, silence_s)
        if wrong and not self._told:
            if self._beat.get("simulated"):
                self.tell(wrong, window=False)
            else:
                self.tell(f"{wrong} The boards stop by their own watchdog. Look at the machine.")
        self._told = wrong

    def died(self) -> None:
        """Report an unannounced end, and send the stop where the port is free."""
        ports = self._beat.get("ports")
        sent = stop_boards([str(port) for port in ports] if isinstance(ports, list) else [])
        self.tell("\n".join(["RoTeMiNa has ended without letting go of the machine.", *sent]))

    def tell(self, text: str, *, window: bool = True) -> None:
        """Say something on the terminal, in the log and on the screen, wherever that can be.

        Without ``window`` it is not on the screen: of a simulator that stands in a window's way.
        """
        line = f"{datetime.now():%Y-%m-%d %H:%M:%S}  watchdog: {text}\n"
        with contextlib.suppress(OSError, ValueError):
            sys.stderr.write(line)
            sys.stderr.flush()
        with contextlib.suppress(OSError), self._log.open("a", encoding="utf-8") as log:
            log.write(line)
        if self._shown and window and (self._window is None or self._window.poll() is not None):
            with contextlib.suppress(OSError):
                self._window = subprocess.Popen(
                    [sys.executable, "-c", _WINDOW, text], stderr=subprocess.DEVNULL
                )

    def _ages(self) -> dict[str, float]:
        ages = self._beat.get("ages")
        return ages if isinstance(ages, dict) else {}


def main(arguments: list[str]) -> int:
    """Watch until the program says farewell or is gone; arguments: log file, and "screen"."""
    watchdog = Watchdog(Path(arguments[0]), shown="screen" in arguments[1:])
    lines: queue.SimpleQueue[str] = queue.SimpleQueue()

    def read() -> None:
        for line in sys.stdin:
            lines.put(line)
        lines.put("")

    threading.Thread(target=read, daemon=True).start()
    heard_s = time.monotonic()
    while True:
        try:
            line = lines.get(timeout=0.25)
        except queue.Empty:
            watchdog.look(time.monotonic() - heard_s)
            continue
        heard_s = time.monotonic()
        if not line:
            watchdog.died()
            return 1
        if not watchdog.take(line):
            return 0
        watchdog.look(0.0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
