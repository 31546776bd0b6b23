"""The section that excites an axis: choose a motion, see its demands, play, stop."""

from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QLineEdit,
    QProgressBar,
    QPushButton,
    QWidget,
)

from rotemina.app.display_units import label
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import error_text, spoken
from rotemina.app.shell.language import translate
from rotemina.app.shell.loaded_trajectory import Plan
from rotemina.app.shell.requests_at_rest import WaitingRequest
from rotemina.app.shell.workbench import NOT_PLAYED, Run, Workbench
from rotemina.app.widgets.controls import allow, set_property
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_grid, in_row
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.excitation import ExcitationRequest, Prepared, Wave, prepared
from rotemina.sim.errors import InputError
from rotemina.sim.quantities import parsed

CHECKING = mark("Computing the motion and checking it on the model …")
_AMPLITUDE = mark(
    "Amplitude each way from the middle, such as 5um, 200urad or 30% of the "
    "range; a value beyond a limit is reduced, with a notice"
)


class ExciteView(QWidget):
    """Choices, a preview of the motion, and its playback through the window's own.

    ``motion`` is what would be played, None until it is made and tried.
    """

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.motion: Prepared | None = None
        #: Waits until the dry run of the motion has ended.
        self._request: WaitingRequest | None = None
        self._last: Prepared | None = None  # what was played last
        self.axis, self.wave = QComboBox(), QComboBox()
        for name in workbench.robot.axes:
            self.axis.addItem(label(name), name)
        for wave in Wave:
            self.wave.addItem(tr(wave.value), wave)
        self.amplitude = _field(tr("Amplitude of the excitation"), tr(_AMPLITUDE))
        self.amplitude.setPlaceholderText(tr("amplitude"))
        self.frequency = _field(
            tr("Frequency of the excitation"),
            tr("Frequency, above 0 Hz; the highest one of a multisine"),
        )
        self.time = _field(
            tr("Time of the excitation"),
            tr("Duration, above 0 s; the rest on each level of a staircase"),
        )
        self.here = QCheckBox(tr("around here"))
        self.here.setToolTip(
            tr("Move around the present position; off: around the middle of the range")
        )
        self.told, self.owner = plain_text(quiet=False, wrap=True), plain_text(wrap=True)
        self.play, self.stop = QPushButton(tr("Play")), QPushButton(tr("Stop"))
        self.play.setProperty("primary", True)
        self.play.setToolTip(tr("Play the motion and analyse the record"))
        self.stop.setToolTip(tr("Stop the machine and end the motion"))
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setTextVisible(False)
        self._lay_out()
        self._connect()
        self._name_fields()

    # --- the motion -------------------------------------------------------------------------------

    def request(self) -> ExcitationRequest:
        """Return what is chosen and typed now."""
        axis, wave = str(self.axis.currentData()), Wave(self.wave.currentData())
        command = self._workbench.session.snapshot().command
        return ExcitationRequest(
            axis,
            wave,
            self.amplitude.text(),
            self.frequency.text() if wave is not Wave.STAIRCASE else "",
            self.time.text(),
            command.get(axis) if self.here.isChecked() else None,
        )

    def prepare(self) -> None:
        """Make the motion and try it, in the background."""
        self.motion = None
        self.told.setText(tr(CHECKING))
        request, robot, session = self.request(), self._workbench.robot, self._workbench.session
        period_s, zone = session.setpoint_period_s, session.bounds.keep_out
        command = session.snapshot().command

        def work() -> Prepared | str:
            try:
                return prepared(robot, request, period_s, zone, command)
            except InputError as error:
                return error_text(error)

        self._workbench.work("excitation", tr(CHECKING), work, self._take, renews=True)

    def start(self) -> None:
        """Take the motion in hand as the window's trajectory, and play it."""
        motion, bench = self.motion, self._workbench
        request = WaitingRequest(bench, translate("shell", NOT_PLAYED))
        if motion is None or motion.digest is None:
            request.withdraw(tr("the motion is not ready"))
            return
        self._last, self._request = motion, request
        record = motion.made.record
        bench.plan_and_play(motion.name, record, request, lambda plan: self._play(plan, request))

    def halt(self) -> None:
        """Stop the machine, and end the playback."""
        if self._request is not None:
            self._request.give_up()
        self._workbench.end_playback()

    def played(self, run: Run) -> Prepared | None:
        """Return the motion that a run is the record of; None if it is another's."""
        digest = run.record.metadata.get("trajectory_digest")
        last = self._last
        return last if last is not None and digest == last.digest else None

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Make the first motion when it is first looked at."""
        super().showEvent(event)
        if self.motion is None:
            self.prepare()
        self.refresh(self._workbench.session.snapshot())

    # --- what may be done -------------------------------------------------------------------------

    def refresh(self, session: SessionState) -> None:
        """Show what can be done now, who drives the axis, and how far the motion is."""
        plan, playback = self._workbench.plan, self._workbench.playback
        waiting = self._waiting  # a stop is noticed while out of sight too
        if not self.isVisible():
            return
        state = playback.state
        ours = plan is not None and self._last is not None
        ours = ours and plan.trajectory is self._last.made.record
        under_way = ours and state.phase is not PlaybackPhase.IDLE
        axis = str(self.axis.currentData())
        driver = session.owners.get(axis)
        owner = tr("{axis}: free")
        if driver:
            owner = tr("{axis}: controlled by {driver}")
        words = owner.format(axis=label(axis), driver=spoken(driver or ""))
        self.owner.setText(tr("Waits until the dry run has ended …") if waiting else words)
        allow(
            self.play, self._why_not(session, state), tr("Play the motion and analyse the record")
        )
        waits = under_way or waiting
        allow(
            self.stop,
            None if waits else tr("the motion is not playing"),
            tr("Stop the machine and end the motion"),
        )
        share = state.path_s / state.duration_s if under_way and state.duration_s else 0.0
        self.progress.setValue(round(1000 * share))

    @property
    def _waiting(self) -> bool:
        return self._request is not None and self._request.waits

    def _play(self, plan: Plan, request: WaitingRequest) -> None:
        """Play the motion, whose dry run has ended.

        It is played at its own pace, and without a bound of the deviation from the model, because
        that deviation is what the motion is to show. All limits hold as ever.
        """
        playback, checked = self._workbench.playback, plan.dry_run.require()
        self._workbench.play_limited(
            plan,
            lambda: request.make(lambda: playback.play(checked, permit=request.permit)),
            request,
        )

    def _why_not(self, session: SessionState, state: PlaybackState) -> str | None:
        motion = self.motion
        if motion is None:
            return tr("the motion is not ready")
        if motion.digest is None:
            return motion.objection
        if self._waiting:
            return tr("it waits until the dry run has ended")
        if state.phase is PlaybackPhase.PLAYING:
            return tr("a trajectory is playing")
        if session.locked is not None:
            return spoken(session.locked)
        return None if session.activity is DeviceState.IDLE else tr("the axes are still moving")

    def _take(self, answer: Prepared | str) -> None:
        if isinstance(answer, str):
            self.told.setText(answer)
        else:
            self.motion = answer
            self.told.setText(answer.words)
        set_property(self.told, "bad", isinstance(answer, str) or answer.digest is None)
        self.refresh(self._workbench.session.snapshot())

    def _changed(self) -> None:
        self._name_fields()
        self.prepare()

    def _name_fields(self) -> None:
        wave = Wave(self.wave.currentData())
        stairs = wave is Wave.STAIRCASE
        self.frequency.setEnabled(not stairs)
        upper = wave is Wave.MULTISINE
        self.frequency.setPlaceholderText(tr("up to [Hz]") if upper else tr("frequency [Hz]"))
        self.time.setPlaceholderText(tr("rest [s]") if stairs else tr("duration [s]"))

    def _connect(self) -> None:
        for choice in (self.axis, self.wave):
            choice.activated.connect(lambda _: self._changed())
        for field in (self.amplitude, self.frequency, self.time):
            field.editingFinished.connect(self._typed)
        self.here.toggled.connect(lambda _: self.prepare())
        self.play.clicked.connect(self.start)
        self.stop.clicked.connect(self.halt)
        self._workbench.refreshed.connect(self.refresh)

    def _typed(self) -> None:
        """Make the motion again where a text is another; leaving a field alone changes nothing."""
        for field, unit in ((self.frequency, "Hz"), (self.time, "s")):
            if parsed(field.text()) is not None:
                field.setText(f"{field.text().strip()} {unit}")  # its name is covered by the number
        if self.motion is None or self.request() != self.motion.request:
            self.prepare()

    def _lay_out(self) -> None:
        self.axis.setAccessibleName(tr("Axis to excite"))
        self.axis.setToolTip(tr("Axis to be excited; the others stay at rest"))
        self.wave.setAccessibleName(tr("Motion of the excitation"))
        self.wave.setToolTip(
            tr("Motion of the excitation; the help (F1) describes what each one shows")
        )
        grid = in_grid(spacing=4)
        fields = (self.axis, self.wave, self.amplitude, self.frequency, self.time, self.here)
        for place, field in enumerate(fields):
            grid.addWidget(field, place // 2, place % 2)
            field.setMinimumWidth(0)
        for column in (0, 1):
            grid.setColumnStretch(column, 1)
        buttons = in_row(self.play, self.stop, (self.progress, 1), spacing=4)
        in_column(grid, buttons, self.owner, self.told, 1, on=self, margins=(0, 0, 8, 0), spacing=4)


def _field(name: str, tip: str) -> QLineEdit:
    field = QLineEdit()
    field.setAccessibleName(name)
    field.setToolTip(tr("{tip}; empty: a value that suits the axis").format(tip=tip))
    return field
