"""The window's main job without a display: play, compare, and leave picture and report."""

import signal
from pathlib import Path

from PySide6.QtCore import QEventLoop, QTimer

from rotemina.app.files import json_text, write_text
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionState
from rotemina.app.settings import Settings
from rotemina.app.shell import language
from rotemina.app.shell.main_window import MainWindow
from rotemina.app.shell.window_run import make_window
from rotemina.app.shell.workbench import Level, Run
from rotemina.sim.comparison.figure import save_figure
from rotemina.sim.comparison.table import table
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record
from rotemina.sim.records.writing import write_record
from rotemina.sim.trajectory.example import example_for

TIME_LIMIT_MS = 120_000
SIZE = (1280, 800)
_INTERRUPTED = "interrupted"


class OffscreenError(InputError):
    """The run without a display could not be completed."""


def run(session: MotionSession, output: Path) -> int:
    """Play the example trajectory in a window that nobody sees, and write what it shows.

    Raises
    ------
    InputError
        If the folder cannot be written or the trajectory cannot be played.
    """
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OffscreenError(f"{output}: the folder cannot be made: {error.strerror}") from error
    settings = Settings(output / "settings.json")
    if not settings.get(language.SETTING, ""):
        settings.set(language.SETTING, language.ENGLISH)  # as what it prints and writes
    window = make_window(session, settings, output / "played")
    try:
        window.resize(*SIZE)
        window.show()
        window.workbench.start()
        finished = play(window, example_for(session.robot))
        picture = output / "window.png"
        if not window.grab().save(str(picture)):
            raise OffscreenError(f"{picture}: the picture cannot be written")
        _report(finished, output)
    finally:
        window.workbench.close()
    return 0


def play(window: MainWindow, trajectory: Record) -> Run:
    """Plan and play a trajectory in a window, and wait for its comparison.

    Raises
    ------
    OffscreenError
        With the notice that the window shows, if anything goes wrong.
    """
    bench = window.workbench
    loop = QEventLoop()
    outcome: list[Run | str] = []

    def finish(result: Run | str) -> None:
        outcome.append(result)
        loop.quit()

    def noticed(level: Level, text: str) -> None:
        if level in (Level.ERROR, Level.WARNING):
            finish(text)

    def begin(state: SessionState) -> None:
        if state.locked is None and bench.plan is not None:
            bench.refreshed.disconnect(begin)
            bench.play()

    bench.plan_trajectory(trajectory.metadata.get("name", "example"), trajectory)
    before = signal.signal(signal.SIGINT, lambda *_: finish(_INTERRUPTED))
    bench.noticed.connect(noticed)
    bench.run_changed.connect(finish)
    bench.refreshed.connect(begin)
    QTimer.singleShot(TIME_LIMIT_MS, loop, lambda: finish("no end within two minutes"))
    loop.exec()
    bench.noticed.disconnect(noticed)
    bench.run_changed.disconnect(finish)
    signal.signal(signal.SIGINT, before)
    if outcome[0] == _INTERRUPTED:
        raise KeyboardInterrupt
    if isinstance(outcome[0], str):
        raise OffscreenError(outcome[0])
    QTimer.singleShot(200, loop.quit)  # the panels draw what they have just been given
    loop.exec()
    return outcome[0]


def _report(run: Run, output: Path) -> None:
    comparison = run.comparison
    write_record(run.record, output / "record.csv")
    save_figure(comparison, output / "comparison.svg")
    write_text(output / "comparison.json", json_text(comparison.as_json()))
    text = f"{run.name}: {run.record.duration_s:.3f} s, {len(run.record.time_s)} samples\n\n"
    write_text(output / "report.txt", text + table(comparison) + "\n")
    print(table(comparison))
    names = ("window.png", "comparison.svg", "report.txt", "comparison.json", "record.csv")
    print(f"\nIn {output.resolve()}: {', '.join(names)}")
