"""The main job without a display: play, compare, correct, write a picture and a report."""

import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from PySide6.QtCore import QEventLoop, QTimer, SignalInstance
from PySide6.QtWidgets import QApplication

from rotemina.app.errors import OffscreenError
from rotemina.app.language import language
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionState
from rotemina.app.settings import UserSettings, format_json, write_text
from rotemina.app.shell.startup.exit_guard import TERMINATION_SIGNALS
from rotemina.app.shell.startup.window_run import make_window
from rotemina.app.shell.window import DIAGNOSE, MainWindow
from rotemina.app.workbench import ComparedRun, Level, format_run_gaps
from rotemina.sim.comparison import format_table, save_figure
from rotemina.sim.errors import (
    describe_exception,
)
from rotemina.sim.messages import (
    format_fixed,
)
from rotemina.sim.records import Record, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.trajectory import load_worn_effects, make_demonstration, make_example

TIME_LIMIT_MS = 120_000
# A diagnosis usually takes 15 s; a busy computer needs more.
DIAGNOSIS_LIMIT_MS = 600_000
WINDOW_SIZE_PX = (1280, 800)
_INTERRUPTION = "interrupted"
_SIGNAL_CHECK_MS = 100
_TIMEOUT_MESSAGE = "timed out: it took much longer than usual"
# Other speed of the second run, so that no record contains its motion.
_SECOND_RUN_PACE = 0.83


def run(session: MotionSession, output: Path) -> int:
    """Run the main job in an invisible window and write what it shows.

    The simulated RoTeMiNa runs the full demonstration with a worn machine: play, compare, diagnose,
    correct the model, play again. Any other machine plays the example, which is then compared.

    Raises
    ------
    InputError
        If the folder cannot be written or something cannot be played or diagnosed.
    """
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OffscreenError(
            "{output}: the folder cannot be created: {strerror}",
            output=output,
            strerror=describe_exception(error),
        ) from error
    with _collect_signals() as signals:
        _run(session, output, signals)
    return 0


@contextmanager
def _collect_signals() -> Iterator[Sequence[int]]:
    """Collect termination signals in this context; the latest one takes effect afterwards.

    They do not interrupt at once: an exception in a slot would be lost, and one in a panel would
    look like a fault of that panel.
    """
    received: list[int] = []

    def receive(number: int, _: object) -> None:
        received.append(number)

    original_handlers = {number: signal.signal(number, receive) for number in TERMINATION_SIGNALS}
    try:
        yield received
    finally:
        for number, handler in original_handlers.items():
            signal.signal(number, handler)
        if received:
            signal.raise_signal(received[-1])


def _run(session: MotionSession, output: Path, signals: Sequence[int]) -> None:
    settings = UserSettings(output / "settings.json")
    if not settings.get(language.LANGUAGE_KEY, ""):
        # The printed and written texts are English as well.
        settings.set(language.LANGUAGE_KEY, language.ENGLISH)
    window = make_window(session, settings, output / "played")
    wear = load_worn_effects(session.robot) if session.service.effects is not None else ()
    try:
        window.show()
        # Showing the window fits it to the offscreen platform's screen, so it is resized
        # afterwards.
        QApplication.processEvents()
        window.resize(*WINDOW_SIZE_PX)
        window.workbench.start()
        if wear and window.panels.make("gap") is not None:
            result = run_demonstration(window, wear, signals)
        else:
            result = OffscreenResult(
                (play_and_compare(window, make_example(session.robot), signals),)
            )
        picture = output / "window.png"
        if not window.grab().save(str(picture)):
            raise OffscreenError("{picture}: the picture cannot be written", picture=picture)
        _write_report(result, output)
    finally:
        window.workbench.close()


class OffscreenResult(NamedTuple):
    """The runs in the order in which they were played, and the result of the diagnosis."""

    runs: tuple[ComparedRun, ...]
    diagnosis: str = ""


def run_demonstration(
    window: MainWindow, effects: tuple[AxisEffect, ...], signals: Sequence[int] = ()
) -> OffscreenResult:
    """Make the simulated machine worn, play, diagnose, use the corrected model and play again.

    Raises
    ------
    OffscreenError
        If anything goes wrong; the message is that of the window's notice.
    """
    bench, panel = window.workbench, window.panels["gap"]
    _wait(window, signals, bench.refreshed, lambda: bench.session.snapshot().lock_reason is None)
    bench.session.service.set_effects(effects)
    _print_now("playing on a worn machine …")
    first_run = play_and_compare(window, make_demonstration(bench.robot), signals)
    window.bring_up("gap")
    _print_now("diagnosing …")
    panel.diagnose()
    _wait(window, signals, bench.refreshed, lambda: panel.answer is not None, DIAGNOSIS_LIMIT_MS)
    _wait(window, signals, bench.refreshed, panel.result.use.isEnabled)
    _print_now("using the corrected model …")
    panel.result.use.click()
    _wait(window, signals, bench.refreshed, lambda: bench.run.model_id.startswith("corrected"))
    _wait(window, signals, bench.refreshed, lambda: not bench.busy)
    _print_now("playing another motion …")
    second_run = play_and_compare(
        window, make_demonstration(bench.robot, _SECOND_RUN_PACE), signals
    )
    _wait(window, signals, bench.refreshed, lambda: panel.result.unseen_motion.latest is not None)
    window.arrangement.arrange(DIAGNOSE)
    window.bring_up("gap")
    panel.result.open_unseen_motion_tab()
    _let_panels_draw()
    return OffscreenResult((first_run, second_run), panel.result.headline.sentence.text())


def _wait(
    window: MainWindow,
    signals: Sequence[int],
    trigger: SignalInstance,
    is_done: Callable[[], bool],
    limit_ms: int = TIME_LIMIT_MS,
    fatal_levels: tuple[Level, ...] = (Level.ERROR,),
) -> None:
    """Run the event loop until a condition holds.

    ``is_done`` is checked whenever ``trigger`` is emitted.

    Raises
    ------
    OffscreenError
        If a notice of one of ``fatal_levels`` appears, with its text, or after ``limit_ms``.
    KeyboardInterrupt
        If a termination signal was received.
    """
    loop = QEventLoop()
    outcome: list[str] = []

    def finish(text: str) -> None:
        outcome.append(text)
        loop.quit()

    def on_notice(level: Level, text: str) -> None:
        if level in fatal_levels:
            finish(text)

    def check_if_done(_: object) -> None:
        if is_done():
            finish("")

    def check_signals() -> None:
        if signals:
            finish(_INTERRUPTION)

    signal_check = QTimer(loop, interval=_SIGNAL_CHECK_MS)
    signal_check.timeout.connect(check_signals)
    signal_check.start()
    window.workbench.notice_posted.connect(on_notice)
    trigger.connect(check_if_done)
    QTimer.singleShot(limit_ms, loop, lambda: finish(_TIMEOUT_MESSAGE))
    loop.exec()
    trigger.disconnect(check_if_done)
    window.workbench.notice_posted.disconnect(on_notice)
    signal_check.stop()
    if outcome[0] == _INTERRUPTION:
        raise KeyboardInterrupt
    if outcome[0]:
        raise OffscreenError(outcome[0])


def _print_now(text: str) -> None:
    print(text, flush=True)


def _let_panels_draw() -> None:
    loop = QEventLoop()
    QTimer.singleShot(200, loop, loop.quit)
    loop.exec()


def play_and_compare(
    window: MainWindow, trajectory: Record, signals: Sequence[int] = ()
) -> ComparedRun:
    """Plan and play a trajectory in a window, and wait for its comparison.

    Raises
    ------
    OffscreenError
        If anything goes wrong; the message is that of the window's notice.
    """
    bench = window.workbench

    def play_when_ready(state: SessionState) -> None:
        is_planned = bench.plan is not None and bench.plan.trajectory is trajectory
        if state.lock_reason is None and is_planned and bench.session.at_rest:
            bench.refreshed.disconnect(play_when_ready)
            bench.play()

    bench.plan_trajectory(trajectory.metadata.get("name", "example"), trajectory)
    bench.refreshed.connect(play_when_ready)
    fatal_levels = (Level.ERROR, Level.WARNING)
    _wait(window, signals, bench.run_changed, lambda: True, fatal_levels=fatal_levels)
    run = bench.run
    _let_panels_draw()
    return run


def _write_report(result: OffscreenResult, output: Path) -> None:
    run = result.runs[-1]
    comparison = run.comparison
    write_record(run.record, output / "record.csv")
    save_figure(comparison, output / "comparison.svg")
    write_text(output / "comparison.json", format_json(comparison.as_json()))
    text = "\n\n".join([*_make_report_lines(result), format_table(comparison)])
    write_text(output / "report.txt", text + "\n")
    print(text)
    names = ("window.png", "comparison.svg", "report.txt", "comparison.json", "record.csv")
    print(f"\nIn {output.resolve()}: {', '.join(names)}")


def _make_report_lines(result: OffscreenResult) -> Iterator[str]:
    for number, run in enumerate(result.runs):
        length = f"{format_fixed(run.record.duration_s, 3)} s, {len(run.record.time_s)} samples"
        yield "\n".join([f"{run.name}: {length}, model {run.model_id}", *format_run_gaps(run)])
        if number == 0 and result.diagnosis:
            yield result.diagnosis
