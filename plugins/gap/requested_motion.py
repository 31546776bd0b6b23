"""A motion that the page wants played: asked for, tried, played, and its record handed back."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QMessageBox, QWidget

from rotemina.app.display_units import axis_scale, label
from rotemina.app.shell.loaded_trajectory import Plan
from rotemina.app.shell.requests_at_rest import WaitingRequest
from rotemina.app.shell.workbench import Run, Workbench
from rotemina.plugins.gap import mark, tr
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot

NOT_PLAYED = mark("Not played: {why}. Ask for the motion again.")


class Playing(QObject):
    """Plays one motion at a time, after a question that says what will move, and how far.

    Signals
    -------
    begun(str) : the operator wants the motion of that name played.
    played(Run) : the motion has ended and its record is compared.
    """

    begun = Signal(str)
    played = Signal(object)

    def __init__(self, workbench: Workbench, parent: QObject) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._under_way: str | None = None
        workbench.run_changed.connect(self._ran)

    def ask(self, window: QWidget, title: str, name: str, trajectory: Record) -> None:
        """Ask whether to play a motion, beside a window that can still be used."""
        question = QMessageBox(window)
        question.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        question.setWindowTitle(title)
        question.setTextFormat(Qt.TextFormat.PlainText)
        question.setText(tr("Play this motion on the machine now?"))
        question.setInformativeText(told(self._workbench.robot, trajectory))
        yes, no = QMessageBox.StandardButton.Yes, QMessageBox.StandardButton.No
        question.setStandardButtons(yes | no)
        question.setDefaultButton(no)
        question.button(yes).setText(tr("Play"))
        question.button(no).setText(tr("Not now"))
        request = WaitingRequest(self._workbench, tr(NOT_PLAYED))

        def answered(answer: int) -> None:
            if request.waits and answer == yes:  # no stop has withdrawn it, and reported that
                self.begun.emit(name)
                self.play(name, trajectory)
            request.give_up()

        question.finished.connect(answered)
        self._workbench.stopped.connect(question.reject)
        question.setModal(False)
        question.show()

    def play(self, name: str, trajectory: Record) -> None:
        """Try a motion on the model, and play it if it stays inside all limits."""
        self._under_way = None
        request = WaitingRequest(self._workbench, tr(NOT_PLAYED))
        self._workbench.plan_and_play(
            name, trajectory, request, lambda plan: self._play(plan, request)
        )

    def _play(self, plan: Plan, request: WaitingRequest) -> None:
        # The motion was made within what the records show, so it needs no question. A higher pace
        # would go beyond that.
        playback, checked = self._workbench.playback, plan.dry_run.require()
        figures = plan.dry_run.axes
        missing = playback.axes_without_speed_limit(checked)
        playback.limit_speeds(checked, {axis: figures[axis].peak_speed for axis in missing})
        self._under_way = plan.name
        self._workbench.play(request.permit)

    def _ran(self, run: Run) -> None:
        if run.name == self._under_way:
            self._under_way = None
            if run.completed:
                self.played.emit(run)


def told(robot: Robot, trajectory: Record) -> str:
    """Return how long a motion lasts, and from where to where it leads each axis."""
    lasts = tr("It takes {time:.3g} s after the move to its first row.")
    lines = [lasts.format(time=trajectory.duration_s)]
    rests = tr("rests at {low} {unit}")
    for axis in trajectory.axes:
        way = trajectory.signal(axis, Tap.CMD)
        scale = axis_scale(robot.axes[axis])
        low, high = scale.number(float(way.min())), scale.number(float(way.max()))
        moves = (
            f"{low} … {high} {scale.symbol}"
            if low != high
            else rests.format(low=low, unit=scale.symbol)
        )
        lines.append(f"{label(axis)}: {moves}")
    return "\n".join(lines)
