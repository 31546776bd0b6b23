"""The window's main job without a display: play, compare, correct; leave picture and report."""

import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from PySide6.QtCore import QEventLoop, QTimer, SignalInstance
from PySide6.QtWidgets import QApplication

from rotemina.app.files import json_text, write_text
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionState
from rotemina.app.settings import Settings
from rotemina.app.shell import language
from rotemina.app.shell.exit_guard import TERMINATION_SIGNALS
from rotemina.app.shell.gap_words import run_lines
from rotemina.app.shell.layouts import DIAGNOSE
from rotemina.app.shell.main_window import MainWindow
from rotemina.app.shell.window_run import make_window
from rotemina.app.shell.workbench import Level, Run
from rotemina.sim.comparison.comparison_picture import save_figure
from rotemina.sim.comparison.table import table
from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed
from rotemina.sim.records.record import Record
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.first_trajectory import example_for
from rotemina.sim.trajectory.worn_machine_demo import demonstration, worn_effects

TIME_LIMIT_MS = 120_000
DIAGNOSIS_LIMIT_MS = 600_000  # on a busy computer; 15 s are usual
SIZE = (1280, 800)
_INTERRUPTED = "interrupted"
_SIGNAL_CHECK_MS = 100
_TOO_LONG = "no end within the time that is usual by far"
_OTHER_PACE = 0.83  # of a motion that no record holds


class OffscreenError(InputError):
    """The run without a display could not be completed."""


def run(session: MotionSession, output: Path) -> int:
    """Play in a window that nobody sees, and write what it shows.

    On the simulated RoTeMiNa the whole story is told with a worn machine: play, compare, diagnose,
    correct the model, play again. Any other machine plays the example and is compared.

    Raises
    ------
    InputError
        If the folder cannot be written or something cannot be played or diagnosed.
    """
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OffscreenError(
            message("engine", "{output}: the folder cannot be created: {strerror}").fill(
                output=output, strerror=reason_of(error)
            )
        ) from error
    with _received_signals() as signals:
        _run(session, output, signals)
    return 0


@contextmanager
def _received_signals() -> Iterator[Sequence[int]]:
    """Return the signals received that ask for an end; the latest takes effect afterwards.

    They do not interrupt at once: an exception in a slot would be lost, and one in a panel would
    look like a fault of that panel.
    """
    received: list[int] = []

    def note(number: int, _: object) -> None:
        received.append(number)

    before = {number: signal.signal(number, note) for number in TERMINATION_SIGNALS}
    try:
        yield received
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        if received:
            signal.raise_signal(received[-1])


def _run(session: MotionSession, output: Path, signals: Sequence[int]) -> None:
    settings = Settings(output / "settings.json")
    if not settings.get(language.SETTING, ""):
        settings.set(language.SETTING, language.ENGLISH)  # as what it prints and writes
    window = make_window(session, settings, output / "played")
    worn = worn_effects(session.robot) if session.service.effects is not None else ()
    try:
        window.show()
        QApplication.processEvents()  # it has been fitted on a screen that is none
        window.resize(*SIZE)
        window.workbench.start()
        if worn and window.panels.make("gap") is not None:
            told = tell_the_story(window, worn, signals)
        else:
            told = Story((play(window, example_for(session.robot), signals),))
        picture = output / "window.png"
        if not window.grab().save(str(picture)):
            raise OffscreenError(
                message("engine", "{picture}: the picture cannot be written").fill(picture=picture)
            )
        _report(told, output)
    finally:
        window.workbench.close()


class Story(NamedTuple):
    """What was played, the last one last, and what was said of it in between."""

    runs: tuple[Run, ...]
    found: str = ""


def tell_the_story(
    window: MainWindow, effects: tuple[AxisEffect, ...], signals: Sequence[int] = ()
) -> Story:
    """Let the simulated machine be worn; play, diagnose, use the corrected model, play again.

    Raises
    ------
    OffscreenError
        With the notice that the window shows, if anything goes wrong.
    """
    bench, panel = window.workbench, window.panels["gap"]
    _wait(window, signals, bench.refreshed, lambda: bench.session.snapshot().locked is None)
    bench.session.service.set_effects(effects)
    _say("playing on a worn machine …")
    before = play(window, demonstration(bench.robot), signals)
    window.bring_up("gap")
    _say("diagnosing …")
    panel.diagnose()
    _wait(window, signals, bench.refreshed, lambda: panel.answer is not None, DIAGNOSIS_LIMIT_MS)
    _wait(window, signals, bench.refreshed, panel.result.use.isEnabled)
    _say("using the corrected model …")
    panel.result.use.click()
    _wait(window, signals, bench.refreshed, lambda: bench.run.model_id.startswith("corrected"))
    _wait(window, signals, bench.refreshed, lambda: not bench.busy)
    _say("playing another motion …")
    after = play(window, demonstration(bench.robot, _OTHER_PACE), signals)
    _wait(window, signals, bench.refreshed, lambda: panel.result.proof.proof is not None)
    window.arrangement.arrange(DIAGNOSE)
    window.bring_up("gap")
    panel.result.turn_to_proof()
    _rest()
    return Story((before, after), panel.result.headline.sentence.text())


def _wait(
    window: MainWindow,
    signals: Sequence[int],
    tick: SignalInstance,
    done: Callable[[], bool],
    limit_ms: int = TIME_LIMIT_MS,
    grave: tuple[Level, ...] = (Level.ERROR,),
) -> None:
    """Let the window live until something is so, a signal asks for an end, or a notice is grave.

    Raises
    ------
    OffscreenError
        With the notice that it shows, or that it takes too long.
    KeyboardInterrupt
        If a signal has asked for an end.
    """
    loop = QEventLoop()
    outcome: list[str] = []

    def finish(text: str) -> None:
        outcome.append(text)
        loop.quit()

    def noticed(level: Level, text: str) -> None:
        if level in grave:
            finish(text)

    def look(_: object) -> None:
        if done():
            finish("")

    def check_signals() -> None:
        if signals:
            finish(_INTERRUPTED)

    signal_check = QTimer(loop, interval=_SIGNAL_CHECK_MS)
    signal_check.timeout.connect(check_signals)
    signal_check.start()
    window.workbench.noticed.connect(noticed)
    tick.connect(look)
    QTimer.singleShot(limit_ms, loop, lambda: finish(_TOO_LONG))
    loop.exec()
    tick.disconnect(look)
    window.workbench.noticed.disconnect(noticed)
    signal_check.stop()
    if outcome[0] == _INTERRUPTED:
        raise KeyboardInterrupt
    if outcome[0]:
        raise OffscreenError(outcome[0])


def _say(what: str) -> None:
    print(what, flush=True)


def _rest() -> None:
    """Let the panels draw what they have just been given."""
    loop = QEventLoop()
    QTimer.singleShot(200, loop, loop.quit)
    loop.exec()


def play(window: MainWindow, trajectory: Record, signals: Sequence[int] = ()) -> Run:
    """Plan and play a trajectory in a window, and wait for its comparison.

    Raises
    ------
    OffscreenError
        With the notice that the window shows, if anything goes wrong.
    """
    bench = window.workbench

    def begin(state: SessionState) -> None:
        planned = bench.plan is not None and bench.plan.trajectory is trajectory
        if state.locked is None and planned and bench.session.at_rest:
            bench.refreshed.disconnect(begin)
            bench.play()

    bench.plan_trajectory(trajectory.metadata.get("name", "example"), trajectory)
    bench.refreshed.connect(begin)
    grave = (Level.ERROR, Level.WARNING)
    _wait(window, signals, bench.run_changed, lambda: True, grave=grave)
    run = bench.run
    _rest()
    return run


def _report(told: Story, output: Path) -> None:
    run = told.runs[-1]
    comparison = run.comparison
    write_record(run.record, output / "record.csv")
    save_figure(comparison, output / "comparison.svg")
    write_text(output / "comparison.json", json_text(comparison.as_json()))
    text = "\n\n".join([*_lines(told), table(comparison)])
    write_text(output / "report.txt", text + "\n")
    print(text)
    names = ("window.png", "comparison.svg", "report.txt", "comparison.json", "record.csv")
    print(f"\nIn {output.resolve()}: {', '.join(names)}")


def _lines(told: Story) -> Iterator[str]:
    for number, run in enumerate(told.runs):
        length = f"{fixed(run.record.duration_s, 3)} s, {len(run.record.time_s)} samples"
        yield "\n".join([f"{run.name}: {length}, model {run.model_id}", *run_lines(run)])
        if number == 0 and told.found:
            yield told.found
