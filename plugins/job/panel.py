"""Running jobs with pause and stop, and the outcome of the last run."""

from collections.abc import Callable
from typing import TypeVar

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QLabel, QProgressBar, QPushButton, QWidget

from rotemina.app.display_units import label
from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel
from rotemina.app.shell.gap_words import RUN, size, small_print
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Level, Run, Workbench
from rotemina.app.widgets.controls import allow, fill, named, plain_tip
from rotemina.app.widgets.labels import ElidedLabel, plain_text
from rotemina.app.widgets.layouts import in_column, in_grid, in_row, keep_room
from rotemina.app.widgets.scroll_areas import scrolled
from rotemina.plugins.job import tr, words
from rotemina.plugins.job.words import Running
from rotemina.plugins.trajectory.playback_controls import PlayButton, waiting_words
from rotemina.sim.records.record import Tap

_STEPS = 1000
_Button = TypeVar("_Button", bound=QPushButton)


class Card(QFrame):
    """Shows the state of a job, with a row of buttons below it."""

    def __init__(self, kind: str) -> None:
        super().__init__()
        self.setObjectName("section")
        self.name, self.doing = ElidedLabel(), ElidedLabel()
        self.kind, self.time = QLabel(kind), QLabel()
        self.time.setTextFormat(Qt.TextFormat.PlainText)
        for quiet in (self.kind, self.doing):
            quiet.setProperty("quiet", True)
        self.name.setProperty("heading", True)
        self.bar = named(QProgressBar(), kind)
        self.bar.setRange(0, _STEPS)
        self.bar.setTextVisible(False)
        keep_room(self, self.doing, self.bar)  # no button moves when another job begins
        self._buttons = in_row(1, spacing=6)
        grid = in_grid(on=self, margins=(2, 4, 2, 6), spacing=(-1, 3), stretched=0)
        grid.addWidget(self.kind, 0, 0)
        grid.addWidget(self.time, 0, 1)
        for row, widget in enumerate((self.name, self.doing, self.bar), start=1):
            grid.addWidget(widget, row, 0, 1, 2)
        grid.addLayout(self._buttons, 4, 0, 1, 2)

    def add_button(self, text: str, tip: str, run: Callable[[], object]) -> QPushButton:
        """Add a button at the right."""
        button = QPushButton(text)
        button.clicked.connect(lambda _: run())
        allow(button, None, tip)
        return self.add(button)

    def add(self, button: _Button) -> _Button:
        """Add a button that acts by itself."""
        self._buttons.addWidget(button)
        return button

    def show_running(self, running: Running | None) -> None:
        """Show the state; None hides the card, whose room stays empty."""
        self.setVisible(running is not None)
        if running is None:
            return
        self.name.show_text(running.name)
        self.doing.show_text(running.doing)
        self.doing.setVisible(bool(running.doing))
        if self.time.text() != running.time:
            self.time.setText(running.time)
        self.bar.setVisible(running.share is not None)
        if running.share is not None:
            fill(self.bar, round(_STEPS * running.share))


_COLUMNS = 2


class ResultView(QFrame):
    """The gaps of a run in two columns, with room for those of all axes from the beginning."""

    def __init__(self, axes: int, bring_up: Callable[[str], object]) -> None:
        super().__init__()
        self.setObjectName("section")
        heading = plain_text(translate("shell", RUN))
        self.name = ElidedLabel()
        self.name.setProperty("heading", True)
        self.gaps = in_grid(spacing=(12, -1))
        for number in range(axes):
            self.gaps.addWidget(QLabel(" "), *divmod(number, _COLUMNS))
        buttons = in_row(1)
        self._buttons: list[tuple[QPushButton, str]] = []
        for text, tip, panel in (
            (
                tr("Compare"),
                tr("Compare model and machine in this run, axis by axis"),
                "comparison",
            ),
            (tr("Diagnose"), tr("Find the effects that explain the gap"), "gap"),
        ):
            button = QPushButton(text)
            allow(button, tr("nothing has been played or opened yet"), tip)
            button.clicked.connect(lambda _=False, panel=panel: bring_up(panel))
            buttons.addWidget(button)
            self._buttons.append((button, tip))
        in_column(heading, self.name, self.gaps, buttons, on=self, margins=(2, 4, 2, 6), spacing=3)
        self.name.show_text(tr("No run yet"))

    def show_run(self, run: Run) -> None:
        """Show the gaps of a run."""
        self.name.show_text(run.name)
        while (item := self.gaps.takeAt(0)) is not None:
            if (old := item.widget()) is not None:
                old.deleteLater()
        found = [(axis, gap) for (axis, tap), gap in run.gaps.items() if tap is Tap.MEAS]
        for number, (axis, figure) in enumerate(found):
            unit = run.record.units[axis]
            text = QLabel(f"{label(axis)}  {size(figure, unit)}")
            text.setToolTip(plain_tip(small_print(figure, unit)))
            self.gaps.addWidget(text, *divmod(number, _COLUMNS))
        for button, tip in self._buttons:
            allow(button, None, tip)


class JobPanel(Panel):
    """A card for the trajectory in hand, and one for everything else that runs."""

    title = marked("panels", "Job")
    area = Area.RIGHT
    order = 5
    help_page = "window.md#job"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._make_playback()
        self._make_others()
        self.result = ResultView(len(workbench.robot.axes), self._bring_up)
        cards = QWidget()
        parts = self.playback, self.result, self.recording, self.penetration, self.motion, 1
        in_column(*parts, on=cards, margins=(8, 4, 8, 4), spacing=4)
        in_column(scrolled(cards), on=self, margins=0)
        self.follow(self.refresh)
        workbench.run_changed.connect(self.result.show_run)

    def _make_playback(self) -> None:
        bench = self.workbench
        self.playback = Card(tr("Trajectory"))
        self.load = self.playback.add_button(
            tr("Load …"),
            tr("Choose a trajectory file; a dry run checks it first"),
            lambda: self.main_window.ask_trajectory(show=False),
        )
        self.end = self.playback.add_button(
            tr("End"), tr("Stop; the next playback starts from the beginning"), bench.end_playback
        )
        self.play = self.playback.add(PlayButton(bench))

    def _make_others(self) -> None:
        stop, held = tr("Stop"), tr("Stop all axes and hold their positions (Esc)")
        show = tr("Show"), tr("Bring its panel to the front")
        self.penetration = Card(tr("Penetration"))
        self.penetration.add_button(*show, lambda: self._bring_up("penetration"))
        self.motion = Card(tr("Motion"))
        for card in (self.penetration, self.motion):
            card.add_button(stop, held, self.workbench.stop)
        self.recording = Card(tr("Recording"))
        self.recording.add_button(*show, lambda: self._bring_up("recorder"))
        self.end_recording = self.recording.add_button(
            tr("End recording"),
            tr("Save the recording in one file; motion continues"),
            self._end_recording,
        )

    def refresh(self, state: SessionState) -> None:
        """Show what runs at a moment of the machine."""
        bench = self.workbench
        self._show_playback(state)
        self.penetration.show_running(words.penetration(bench.operation.penetration.status))
        self.motion.show_running(words.motion(state))
        recorder = bench.operation.recording
        if recorder is None:
            self.recording.show_running(None)
            return
        writer = recorder.writer
        since_s = bench.operation.clock() - writer.began_s
        self.recording.show_running(
            words.recording(writer.path, since_s, writer.bytes_written, writer.failure)
        )

    def _show_playback(self, state: SessionState) -> None:
        bench = self.workbench
        playback = bench.playback.state
        name = bench.plan.name if bench.plan is not None else ""
        idle = playback.phase is PlaybackPhase.IDLE
        running = words.playback(playback, name, bench.robot)
        if idle and (waits := waiting_words(bench)):
            running = running._replace(doing=waits)
        self.playback.show_running(running)
        tip = tr("Stop; the next playback starts from the beginning")
        allow(self.end, tr("nothing is playing") if idle else None, tip)
        self.play.refresh(state)

    def _end_recording(self) -> None:
        recorder = self.workbench.operation.recording
        if recorder is None:
            self.workbench.notify(Level.INFO, tr("The recording has ended already."), about=self)
            return
        path = recorder.writer.path
        tip = tr("Save the recording in one file; motion continues")
        allow(self.end_recording, tr("the recording is being saved"), tip)

        def done() -> None:
            allow(self.end_recording, None, tip)
            text = tr("Saved the recording {path}").format(path=path)
            self.workbench.notify(Level.GOOD, text)

        self.workbench.finish_recording(done, lambda: allow(self.end_recording, None, tip))

    def _bring_up(self, name: str) -> None:
        self.main_window.bring_up(name)
