"""Plays a motion that the gap page requests, after a confirmation and a check."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QMessageBox, QWidget

from rotemina.app.language import choose_axis_scale, get_axis_label
from rotemina.app.workbench import ComparedRun, TrajectoryPlan, WaitingRequest, Workbench
from rotemina.plugins.gap import mark, tr
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot

NOT_PLAYED = mark("Not played: {why}. Ask for the motion again.")


class RequestedMotion(QObject):
    """Plays one motion at a time. The confirmation shows which axes will move, and how far.

    Signals
    -------
    begun(str) : the operator has confirmed the motion with this name.
    played(ComparedRun) : the motion has ended, and its record was compared with the model.
    """

    begun = Signal(str)
    played = Signal(object)

    def __init__(self, workbench: Workbench, parent: QObject) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._playing_name: str | None = None
        workbench.run_changed.connect(self._on_run_changed)

    def ask(self, window: QWidget, title: str, name: str, trajectory: Record) -> None:
        """Ask whether to play a motion. The window can be used meanwhile."""
        question = QMessageBox(window)
        question.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        question.setWindowTitle(title)
        question.setTextFormat(Qt.TextFormat.PlainText)
        question.setText(tr("Play this motion on the machine now?"))
        question.setInformativeText(describe_motion(self._workbench.robot, trajectory))
        yes, no = QMessageBox.StandardButton.Yes, QMessageBox.StandardButton.No
        question.setStandardButtons(yes | no)
        question.setDefaultButton(no)
        question.button(yes).setText(tr("Play"))
        question.button(no).setText(tr("Not now"))
        request = WaitingRequest(self._workbench, tr(NOT_PLAYED))

        def on_answer(answer: int) -> None:
            # A stop cancels the request and reports the cancellation.
            if request.is_waiting and answer == yes:
                self.begun.emit(name)
                self.play(name, trajectory)
            request.end_silently()

        question.finished.connect(on_answer)
        self._workbench.stopped.connect(question.reject)
        question.setModal(False)
        question.show()

    def play(self, name: str, trajectory: Record) -> None:
        """Check a motion in a dry run, and play it if it stays inside all limits."""
        self._playing_name = None
        request = WaitingRequest(self._workbench, tr(NOT_PLAYED))
        self._workbench.plan_and_play(
            name, trajectory, request, lambda plan: self._play(plan, request)
        )

    def _play(self, plan: TrajectoryPlan, request: WaitingRequest) -> None:
        # The motion is not faster than the diagnosed records, so the operator need not enter a
        # limit for an axis that has none. The peak speeds of the dry run become the limits, so that
        # the motion cannot be played faster either.
        playback, checked_motion = self._workbench.playback, plan.dry_run.require()
        dry_run_axes = plan.dry_run.axes
        unlimited_axes = playback.axes_without_speed_limit(checked_motion)
        playback.limit_speeds(
            checked_motion, {axis: dry_run_axes[axis].peak_speed for axis in unlimited_axes}
        )
        self._playing_name = plan.name
        self._workbench.play(request.permit)

    def _on_run_changed(self, run: ComparedRun) -> None:
        if run.name == self._playing_name:
            self._playing_name = None
            if run.completed:
                self.played.emit(run)


def describe_motion(robot: Robot, trajectory: Record) -> str:
    """Describe the duration of a motion and the range of each axis."""
    duration_text = tr("It takes {time:.3g} s after the move to its first row.")
    lines = [duration_text.format(time=trajectory.duration_s)]
    rest_text = tr("rests at {low} {unit}")
    for axis in trajectory.axes:
        positions = trajectory.signal(axis, Tap.CMD)
        scale = choose_axis_scale(robot.axes[axis])
        low, high = (
            scale.format_value(float(positions.min())),
            scale.format_value(float(positions.max())),
        )
        range_text = (
            f"{low} … {high} {scale.symbol}"
            if low != high
            else rest_text.format(low=low, unit=scale.symbol)
        )
        lines.append(f"{get_axis_label(axis)}: {range_text}")
    return "\n".join(lines)
