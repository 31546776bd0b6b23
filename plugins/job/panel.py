"""The Job panel: the running jobs, buttons to pause and stop them, and the last run's gaps."""

from collections.abc import Callable
from typing import TypeVar

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QLabel, QProgressBar, QPushButton, QWidget

from rotemina.app.language import get_axis_label, marked, translate
from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Panel, PanelArea
from rotemina.app.widgets.controls import (
    enable_unless,
    make_tooltip,
    name_widget,
    set_bar_value,
)
from rotemina.app.widgets.layout import (
    keep_room_when_hidden,
    make_column,
    make_grid,
    make_row,
    make_scroll_area,
)
from rotemina.app.widgets.text import ElidedLabel, make_plain_label
from rotemina.app.workbench import (
    RUN_GAP_LABEL,
    ComparedRun,
    Level,
    Workbench,
    format_gap_details,
    format_gap_size,
)
from rotemina.plugins.job import tr, words
from rotemina.plugins.job.words import JobState
from rotemina.plugins.trajectory import PlayButton, describe_waiting
from rotemina.sim.records import Tap

_PROGRESS_STEPS = 1000
_Button = TypeVar("_Button", bound=QPushButton)


class JobCard(QFrame):
    """Card with the state of a job and a row of buttons below it."""

    def __init__(self, kind: str) -> None:
        super().__init__()
        self.setObjectName("section")
        self.name, self.activity = ElidedLabel(), ElidedLabel()
        self.kind, self.time = QLabel(kind), QLabel()
        self.time.setTextFormat(Qt.TextFormat.PlainText)
        for label in (self.kind, self.activity):
            label.setProperty("quiet", True)
        self.name.setProperty("heading", True)
        self.bar = name_widget(QProgressBar(), kind)
        self.bar.setRange(0, _PROGRESS_STEPS)
        self.bar.setTextVisible(False)
        # The card keeps its space while it is hidden, so that no button moves when a job begins.
        keep_room_when_hidden(self, self.activity, self.bar)
        self._buttons = make_row(1, spacing=6)
        grid = make_grid(on=self, margins=(2, 4, 2, 6), spacing=(-1, 3), stretched=0)
        grid.addWidget(self.kind, 0, 0)
        grid.addWidget(self.time, 0, 1)
        for row, widget in enumerate((self.name, self.activity, self.bar), start=1):
            grid.addWidget(widget, row, 0, 1, 2)
        grid.addLayout(self._buttons, 4, 0, 1, 2)

    def add_button(self, text: str, tooltip: str, run: Callable[[], object]) -> QPushButton:
        """Add a button on the right."""
        button = QPushButton(text)
        button.clicked.connect(lambda _: run())
        enable_unless(button, None, tooltip)
        return self.place_button(button)

    def place_button(self, button: _Button) -> _Button:
        """Add a button on the right that already has its text and action."""
        self._buttons.addWidget(button)
        return button

    def show_job(self, state: JobState | None) -> None:
        """Show the state of the job. With None, hide the card but keep its space."""
        self.setVisible(state is not None)
        if state is None:
            return
        self.name.show_text(state.name)
        self.activity.show_text(state.activity)
        self.activity.setVisible(bool(state.activity))
        if self.time.text() != state.time:
            self.time.setText(state.time)
        self.bar.setVisible(state.share is not None)
        if state.share is not None:
            set_bar_value(self.bar, round(_PROGRESS_STEPS * state.share))


_GAP_COLUMN_COUNT = 2


class RunResultView(QFrame):
    """View of the gaps of a run in two columns, with space for all axes from the start."""

    def __init__(self, axis_count: int, bring_up: Callable[[str], object]) -> None:
        super().__init__()
        self.setObjectName("section")
        heading = make_plain_label(translate("shell", RUN_GAP_LABEL))
        self.name = ElidedLabel()
        self.name.setProperty("heading", True)
        self.gaps = make_grid(spacing=(12, -1))
        for index in range(axis_count):
            self.gaps.addWidget(QLabel(" "), *divmod(index, _GAP_COLUMN_COUNT))
        buttons = make_row(1)
        self._buttons: list[tuple[QPushButton, str]] = []
        for text, tooltip, panel in (
            (
                tr("Compare"),
                tr("Compare model and machine in this run, axis by axis"),
                "comparison",
            ),
            (tr("Diagnose"), tr("Find the effects that explain the gap"), "gap"),
        ):
            button = QPushButton(text)
            enable_unless(button, tr("nothing has been played or opened yet"), tooltip)
            button.clicked.connect(lambda _=False, panel=panel: bring_up(panel))
            buttons.addWidget(button)
            self._buttons.append((button, tooltip))
        make_column(
            heading, self.name, self.gaps, buttons, on=self, margins=(2, 4, 2, 6), spacing=3
        )
        self.name.show_text(tr("No run yet"))

    def show_run(self, run: ComparedRun) -> None:
        """Show the gaps of a run."""
        self.name.show_text(run.name)
        while (item := self.gaps.takeAt(0)) is not None:
            if (old_label := item.widget()) is not None:
                old_label.deleteLater()
        gaps = [(axis, gap) for (axis, tap), gap in run.gaps.items() if tap is Tap.MEAS]
        for index, (axis, gap) in enumerate(gaps):
            unit = run.record.units[axis]
            label = QLabel(f"{get_axis_label(axis)}  {format_gap_size(gap, unit)}")
            label.setToolTip(make_tooltip(format_gap_details(gap, unit)))
            self.gaps.addWidget(label, *divmod(index, _GAP_COLUMN_COUNT))
        for button, tooltip in self._buttons:
            enable_unless(button, None, tooltip)


class JobPanel(Panel):
    """Panel with a card for the loaded trajectory, and one for each other running job."""

    title = marked("panels", "Job")
    area = PanelArea.RIGHT
    order = 5
    help_page = "window.md#job"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._make_playback_card()
        self._make_other_cards()
        self.result = RunResultView(len(workbench.robot.axes), self._bring_up)
        cards = QWidget()
        parts = self.playback, self.result, self.recording, self.penetration, self.motion, 1
        make_column(*parts, on=cards, margins=(8, 4, 8, 4), spacing=4)
        make_column(make_scroll_area(cards), on=self, margins=0)
        self.follow(self.refresh)
        workbench.run_changed.connect(self.result.show_run)

    def _make_playback_card(self) -> None:
        workbench = self.workbench
        self.playback = JobCard(tr("Trajectory"))
        self.load = self.playback.add_button(
            tr("Load …"),
            tr("Choose a trajectory file; a dry run checks it first"),
            lambda: self.main_window.ask_trajectory(show=False),
        )
        self.end = self.playback.add_button(
            tr("End"),
            tr("Stop; the next playback starts from the beginning"),
            workbench.end_playback,
        )
        self.play = self.playback.place_button(PlayButton(workbench))

    def _make_other_cards(self) -> None:
        stop_text, stop_tooltip = tr("Stop"), tr("Stop all axes and hold their positions (Esc)")
        show_text, show_tooltip = tr("Show"), tr("Bring its panel to the front")
        self.penetration = JobCard(tr("Penetration"))
        self.penetration.add_button(show_text, show_tooltip, lambda: self._bring_up("penetration"))
        self.motion = JobCard(tr("Motion"))
        for card in (self.penetration, self.motion):
            card.add_button(stop_text, stop_tooltip, self.workbench.stop)
        self.recording = JobCard(tr("Recording"))
        self.recording.add_button(show_text, show_tooltip, lambda: self._bring_up("recorder"))
        self.end_recording = self.recording.add_button(
            tr("End recording"),
            tr("Save the recording in one file; motion continues"),
            self._end_recording,
        )

    def refresh(self, state: SessionState) -> None:
        """Show the running jobs."""
        workbench = self.workbench
        self._show_playback(state)
        self.penetration.show_job(
            words.describe_penetration_job(workbench.operation.penetration.status)
        )
        self.motion.show_job(words.describe_motion_job(state))
        recorder = workbench.operation.recording
        if recorder is None:
            self.recording.show_job(None)
            return
        writer = recorder.writer
        elapsed_s = workbench.operation.clock() - writer.began_s
        self.recording.show_job(
            words.describe_recording_job(
                writer.path, elapsed_s, writer.bytes_written, writer.failure
            )
        )

    def _show_playback(self, state: SessionState) -> None:
        workbench = self.workbench
        playback = workbench.playback.state
        name = workbench.plan.name if workbench.plan is not None else ""
        is_idle = playback.phase is PlaybackPhase.IDLE
        job = words.describe_playback_job(playback, name, workbench.robot)
        if is_idle and (waiting_text := describe_waiting(workbench)):
            job = job._replace(activity=waiting_text)
        self.playback.show_job(job)
        tooltip = tr("Stop; the next playback starts from the beginning")
        enable_unless(self.end, tr("nothing is playing") if is_idle else None, tooltip)
        self.play.refresh(state)

    def _end_recording(self) -> None:
        recorder = self.workbench.operation.recording
        if recorder is None:
            self.workbench.notify(Level.INFO, tr("The recording has ended already."), about=self)
            return
        path = recorder.writer.path
        tooltip = tr("Save the recording in one file; motion continues")
        enable_unless(self.end_recording, tr("the recording is being saved"), tooltip)

        def on_saved() -> None:
            enable_unless(self.end_recording, None, tooltip)
            text = tr("Saved the recording {path}").format(path=path)
            self.workbench.notify(Level.GOOD, text)

        self.workbench.finish_recording(
            on_saved, lambda: enable_unless(self.end_recording, None, tooltip)
        )

    def _bring_up(self, name: str) -> None:
        self.main_window.bring_up(name)
