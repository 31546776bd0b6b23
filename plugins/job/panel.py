"""What runs now, with pause and stop, and what came of the last run."""

from PySide6.QtWidgets import QVBoxLayout, QWidget

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow
from rotemina.app.widgets.scroll import scrolled
from rotemina.plugins.job import words
from rotemina.plugins.job.card import Card
from rotemina.plugins.job.result import ResultView
from rotemina.plugins.trajectory.transport import against_playing, play_word


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
        self.result = ResultView(self._bring_up)
        cards = QWidget()
        column = QVBoxLayout(cards)
        column.setContentsMargins(8, 4, 8, 4)
        column.setSpacing(4)
        for card in (self.playback, self.penetration, self.motion, self.recording, self.result):
            column.addWidget(card)
        column.addStretch(1)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(scrolled(cards))
        self.follow(self.refresh)
        workbench.run_changed.connect(self.result.show_run)

    def _make_playback(self) -> None:
        bench = self.workbench
        self.playback = Card(translate("job", "Trajectory"))
        self.load = self.playback.add_button(
            translate("job", "Load …"),
            translate("job", "Choose a trajectory file; a dry run checks it first"),
            lambda: self.main_window.ask_trajectory(),
        )
        self.end = self.playback.add_button(
            translate("job", "End"),
            translate("job", "Stop; the next playback starts from the beginning"),
            bench.end_playback,
        )
        self.play = self.playback.add_button("", "", bench.toggle_playback)
        self.play.setProperty("primary", True)

    def _make_others(self) -> None:
        stop, held = (
            translate("job", "Stop"),
            translate("job", "Stop all axes and hold their positions (Esc)"),
        )
        show = translate("job", "Show"), translate("job", "Bring its panel to the front")
        self.penetration = Card(translate("job", "Penetration"))
        self.penetration.add_button(*show, lambda: self._bring_up("penetration"))
        self.motion = Card(translate("job", "Motion"))
        for card in (self.penetration, self.motion):
            card.add_button(stop, held, self.workbench.stop)
        self.recording = Card(translate("job", "Recording"))
        self.recording.add_button(*show, lambda: self._bring_up("recorder"))
        self.end_recording = self.recording.add_button(
            translate("job", "End recording"),
            translate("job", "Save the recording in one file; motion continues"),
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
        self.playback.show_running(words.playback(playback, name))
        playing = playback.phase is PlaybackPhase.PLAYING
        idle = playback.phase is PlaybackPhase.IDLE
        self.load.setVisible(idle)
        self.end.setVisible(not idle)
        self.play.setText(play_word(playback.phase))
        allow(
            self.play,
            None if playing else against_playing(bench, state),
            translate(
                "job", "Play, pause or resume (Ctrl+P); the axes first move to the first row"
            ),
        )

    def _end_recording(self) -> None:
        recorder = self.workbench.operation.recording
        if recorder is None:
            return
        path = recorder.writer.path
        self.end_recording.setEnabled(False)

        def done() -> None:
            self.end_recording.setEnabled(True)
            text = translate("job", "Saved the recording {path}").format(path=path)
            self.workbench.notify(Level.GOOD, text)

        self.workbench.finish_recording(done, lambda: self.end_recording.setEnabled(True))

    def _bring_up(self, name: str) -> None:
        self.main_window.bring_up(name)
