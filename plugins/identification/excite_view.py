"""Section that excites an axis: the operator chooses a motion, checks it, plays and stops it."""

from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QLineEdit,
    QProgressBar,
    QPushButton,
    QWidget,
)

from rotemina.app.language import describe_error, get_axis_label, translate, translate_message
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import enable_unless, set_property
from rotemina.app.widgets.layout import (
    make_column,
    make_grid,
    make_row,
)
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import (
    NOT_PLAYED,
    ComparedRun,
    TrajectoryPlan,
    WaitingRequest,
    Workbench,
)
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.excitation import (
    ExcitationRequest,
    ExcitationWave,
    PreparedExcitation,
    prepare_excitation,
)
from rotemina.sim.errors import InputError
from rotemina.sim.messages import parse_number

CHECKING = mark("Computing the motion and checking it on the model …")
_AMPLITUDE_TOOLTIP = mark(
    "Amplitude each way from the middle, such as 5um, 200urad or 30% of the "
    "range; a value beyond a limit is reduced, with a notice"
)


class ExcitationView(QWidget):
    """Section that checks the chosen motion on the model, and plays it as the window's trajectory.

    ``motion`` is the motion to be played, or None until it is computed and checked.
    """

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.motion: PreparedExcitation | None = None
        # The request to play, which waits until the dry run of the motion has ended.
        self._request: WaitingRequest | None = None
        self._last_played: PreparedExcitation | None = None
        self.axis, self.wave = QComboBox(), QComboBox()
        for name in workbench.robot.axes:
            self.axis.addItem(get_axis_label(name), name)
        for wave in ExcitationWave:
            self.wave.addItem(tr(wave.value), wave)
        self.amplitude = _make_field(tr("Amplitude of the excitation"), tr(_AMPLITUDE_TOOLTIP))
        self.amplitude.setPlaceholderText(tr("amplitude"))
        self.frequency = _make_field(
            tr("Frequency of the excitation"),
            tr("Frequency, above 0 Hz; the highest one of a multisine"),
        )
        self.time = _make_field(
            tr("Time of the excitation"),
            tr("Duration, above 0 s; the rest on each level of a staircase"),
        )
        self.here = QCheckBox(tr("around here"))
        self.here.setToolTip(
            tr("Move around the present position; off: around the middle of the range")
        )
        self.report, self.owner = (
            make_plain_label(quiet=False, wrap=True),
            make_plain_label(wrap=True),
        )
        self.play, self.stop = QPushButton(tr("Play")), QPushButton(tr("Stop"))
        self.play.setProperty("primary", True)
        self.play.setToolTip(tr("Play the motion and analyse the record"))
        self.stop.setToolTip(tr("Stop the machine and end the motion"))
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setTextVisible(False)
        self._lay_out()
        self._connect()
        self._update_placeholders()

    def make_request(self) -> ExcitationRequest:
        """Return the request as it is currently chosen and typed."""
        axis, wave = str(self.axis.currentData()), ExcitationWave(self.wave.currentData())
        command = self._workbench.session.snapshot().command
        return ExcitationRequest(
            axis,
            wave,
            self.amplitude.text(),
            self.frequency.text() if wave is not ExcitationWave.STAIRCASE else "",
            self.time.text(),
            command.get(axis) if self.here.isChecked() else None,
        )

    def prepare(self) -> None:
        """Compute the motion and check it, in the background."""
        self.motion = None
        self.report.setText(tr(CHECKING))
        request, robot, session = (
            self.make_request(),
            self._workbench.robot,
            self._workbench.session,
        )
        period_s, zone = session.setpoint_period_s, session.bounds.keep_out
        command = session.snapshot().command

        def prepare_or_explain() -> PreparedExcitation | str:
            try:
                return prepare_excitation(robot, request, period_s, zone, command)
            except InputError as error:
                return describe_error(error)

        self._workbench.work(
            "excitation", tr(CHECKING), prepare_or_explain, self._on_prepared, renews=True
        )

    def start(self) -> None:
        """Load the motion as the trajectory of the window, and play it."""
        motion, workbench = self.motion, self._workbench
        request = WaitingRequest(workbench, translate("shell", NOT_PLAYED))
        if motion is None or motion.digest is None:
            request.withdraw(tr("the motion is not ready"))
            return
        self._last_played, self._request = motion, request
        record = motion.excitation.record
        workbench.plan_and_play(
            motion.name, record, request, lambda plan: self._play(plan, request)
        )

    def stop_motion(self) -> None:
        """Stop the machine and end the playback."""
        if self._request is not None:
            self._request.end_silently()
        self._workbench.end_playback()

    def find_played_motion(self, run: ComparedRun) -> PreparedExcitation | None:
        """Return the motion that a run recorded, or None if the run had another trajectory."""
        digest = run.record.metadata.get("trajectory_digest")
        motion = self._last_played
        return motion if motion is not None and digest == motion.digest else None

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Compute the first motion when the section is first shown."""
        super().showEvent(event)
        if self.motion is None:
            self.prepare()
        self.refresh(self._workbench.session.snapshot())

    def refresh(self, session: SessionState) -> None:
        """Enable or disable the buttons, and show the owner of the axis and the progress."""
        plan, playback = self._workbench.plan, self._workbench.playback
        # Evaluated even while the section is hidden, because this also detects a stop.
        is_waiting = self._is_waiting
        if not self.isVisible():
            return
        state = playback.state
        is_own_plan = plan is not None and self._last_played is not None
        is_own_plan = is_own_plan and plan.trajectory is self._last_played.excitation.record
        is_under_way = is_own_plan and state.phase is not PlaybackPhase.IDLE
        axis = str(self.axis.currentData())
        owner = session.owners.get(axis)
        owner_text = tr("{axis}: free")
        if owner:
            owner_text = tr("{axis}: controlled by {driver}")
        owner_text = owner_text.format(
            axis=get_axis_label(axis), driver=translate_message(owner or "")
        )
        self.owner.setText(tr("Waits until the dry run has ended …") if is_waiting else owner_text)
        enable_unless(
            self.play,
            self._find_play_objection(session, state),
            tr("Play the motion and analyse the record"),
        )
        can_stop = is_under_way or is_waiting
        enable_unless(
            self.stop,
            None if can_stop else tr("the motion is not playing"),
            tr("Stop the machine and end the motion"),
        )
        fraction = state.path_s / state.duration_s if is_under_way and state.duration_s else 0.0
        self.progress.setValue(round(1000 * fraction))

    @property
    def _is_waiting(self) -> bool:
        return self._request is not None and self._request.is_waiting

    def _play(self, plan: TrajectoryPlan, request: WaitingRequest) -> None:
        """Play the motion after its dry run.

        It is played at its original speed, and without a limit on the deviation from the model,
        because the purpose of the motion is to measure that deviation. All other limits apply.
        """
        playback, checked_motion = self._workbench.playback, plan.dry_run.require()
        self._workbench.play_with_speed_limit(
            plan,
            lambda: request.make(lambda: playback.play(checked_motion, permit=request.permit)),
            request,
        )

    def _find_play_objection(self, session: SessionState, state: PlaybackState) -> str | None:
        motion = self.motion
        if motion is None:
            return tr("the motion is not ready")
        if motion.digest is None:
            return motion.objection
        if self._is_waiting:
            return tr("it waits until the dry run has ended")
        if state.phase is PlaybackPhase.PLAYING:
            return tr("a trajectory is playing")
        if session.lock_reason is not None:
            return translate_message(session.lock_reason)
        return None if session.activity is DeviceState.IDLE else tr("the axes are still moving")

    def _on_prepared(self, answer: PreparedExcitation | str) -> None:
        if isinstance(answer, str):
            self.report.setText(answer)
        else:
            self.motion = answer
            self.report.setText(answer.description)
        set_property(self.report, "bad", isinstance(answer, str) or answer.digest is None)
        self.refresh(self._workbench.session.snapshot())

    def _on_choice_changed(self) -> None:
        self._update_placeholders()
        self.prepare()

    def _update_placeholders(self) -> None:
        wave = ExcitationWave(self.wave.currentData())
        is_staircase = wave is ExcitationWave.STAIRCASE
        self.frequency.setEnabled(not is_staircase)
        is_multisine = wave is ExcitationWave.MULTISINE
        self.frequency.setPlaceholderText(
            tr("up to [Hz]") if is_multisine else tr("frequency [Hz]")
        )
        self.time.setPlaceholderText(tr("rest [s]") if is_staircase else tr("duration [s]"))

    def _connect(self) -> None:
        for choice in (self.axis, self.wave):
            choice.activated.connect(lambda _: self._on_choice_changed())
        for field in (self.amplitude, self.frequency, self.time):
            field.editingFinished.connect(self._on_text_edited)
        self.here.toggled.connect(lambda _: self.prepare())
        self.play.clicked.connect(self.start)
        self.stop.clicked.connect(self.stop_motion)
        self._workbench.refreshed.connect(self.refresh)

    def _on_text_edited(self) -> None:
        for field, unit in ((self.frequency, "Hz"), (self.time, "s")):
            if parse_number(field.text()) is not None:
                # The number hides the placeholder, which shows the unit.
                field.setText(f"{field.text().strip()} {unit}")
        if self.motion is None or self.make_request() != self.motion.request:
            self.prepare()

    def _lay_out(self) -> None:
        self.axis.setAccessibleName(tr("Axis to excite"))
        self.axis.setToolTip(tr("Axis to be excited; the others stay at rest"))
        self.wave.setAccessibleName(tr("Motion of the excitation"))
        self.wave.setToolTip(
            tr("Motion of the excitation; the help (F1) describes what each one shows")
        )
        grid = make_grid(spacing=4)
        fields = (self.axis, self.wave, self.amplitude, self.frequency, self.time, self.here)
        for index, field in enumerate(fields):
            grid.addWidget(field, index // 2, index % 2)
            field.setMinimumWidth(0)
        for column in (0, 1):
            grid.setColumnStretch(column, 1)
        buttons = make_row(self.play, self.stop, (self.progress, 1), spacing=4)
        make_column(
            grid, buttons, self.owner, self.report, 1, on=self, margins=(0, 0, 8, 0), spacing=4
        )


def _make_field(name: str, tooltip: str) -> QLineEdit:
    field = QLineEdit()
    field.setAccessibleName(name)
    field.setToolTip(tr("{tip}; empty: a value that suits the axis").format(tip=tooltip))
    return field
