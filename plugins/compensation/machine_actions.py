"""Actions on the machine: inverse, loop, sweep and trials."""

from collections.abc import Callable

from rotemina.app.language import get_axis_label, translate_message
from rotemina.app.motion.session import NamedInverse, NamedRegulation, make_regulation
from rotemina.app.motion.state import (
    PlaybackFinished,
    SessionEvent,
    SessionState,
)
from rotemina.app.widgets.controls import enable_unless
from rotemina.app.workbench import Level, WaitingRequest, Workbench
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.controls import CompensationControls
from rotemina.plugins.compensation.inverse_training import TrainedInverses
from rotemina.plugins.compensation.plot_views import LiveView
from rotemina.plugins.compensation.trial_motion import (
    CompensationMode,
    CompensationTrial,
    evaluate_trial,
    make_trial_motion,
)
from rotemina.plugins.compensation.typed_gains import make_typed_loop
from rotemina.plugins.compensation.words import (
    AT_A_LIMIT,
    INVERSE_BUTTON_TEXTS,
    LOOP_BUTTON_TEXTS,
    SWEEP_TIP,
    describe_owners,
    exceedance_text,
    residual_text,
)
from rotemina.sim.compensate import KIND_NAMES, make_conditioning_sweep
from rotemina.sim.feedback import ControllerGains
from rotemina.sim.records import Record
from rotemina.sim.robot import Robot
from rotemina.sim.tuning import TuningResult

NOT_PLAYED = mark("Not played: {why}. Press the button again.")


class CompensationActions:
    """Actions that apply and remove inverses and loops, and play trials.

    Parameters
    ----------
    workbench : Workbench
    controls : CompensationControls
    live : LiveView
        View in which trials are drawn.
    """

    def __init__(
        self, workbench: Workbench, controls: CompensationControls, live: LiveView
    ) -> None:
        self._workbench, self._controls, self._live = workbench, controls, live
        self.trials: dict[CompensationMode, CompensationTrial] = {}

    def switch(self, inverses: TrainedInverses | None, source: str) -> None:
        """Apply the chosen inverse to its axis, or remove the one that is applied."""
        session, axis = self._workbench.session, self._controls.chosen
        if axis in session.inverses.applied:
            self._workbench.run_request(lambda: session.inverses.remove(axis))
            return
        if inverses is None or inverses.axis != axis:
            text = tr("Nothing is applied: no inverse of {axis} is trained. Train one first.")
            self._workbench.notify(
                Level.WARNING, text.format(axis=get_axis_label(axis)), about="compensation.md"
            )
            return
        kind = self._controls.kind.currentData()
        name = f"{KIND_NAMES[kind]}, {source}"
        inverse = NamedInverse(inverses.trained.models[kind], inverses.provenance.robot, name)
        self._workbench.run_request(lambda: session.inverses.apply(inverse))

    def apply(self, tuning: TuningResult | None, name: str) -> None:
        """Close a loop with the gains shown, if it is stable. Open the loop if it is closed.

        The gains are those of the selected point, unless the operator has typed others.
        """
        workbench, axis = self._workbench, self._controls.chosen
        session, robot = workbench.session, workbench.robot
        if axis in session.loops.applied:
            workbench.run_request(lambda: session.loops.remove(axis))
            return
        axis_tuning = tuning if tuning is not None and tuning.axis == axis else None
        # A stop during the check of the loop revokes this permit.
        permit = session.permit()

        def on_made(loop: NamedRegulation) -> None:
            workbench.run_request(lambda: session.loops.apply(loop, permit=permit))

        make_loop = self._make_loop_factory(robot, axis, axis_tuning, name)
        if make_loop is not None:
            workbench.work("apply gains", tr("Checking the loop …"), make_loop, on_made)

    def _make_loop_factory(
        self, robot: Robot, axis: str, tuning: TuningResult | None, name: str
    ) -> Callable[[], NamedRegulation] | None:
        """Return a function that makes the loop, or None after reporting invalid typed gains."""
        fields = self._controls.typed
        if tuning is not None and not fields.typed:
            return lambda: make_regulation(robot, tuning, name)
        typed_gains: list[ControllerGains] = []
        point_gains = tuning.chosen_point.gains if tuning is not None else None
        if not self._workbench.run_request(
            lambda: typed_gains.append(fields.read_gains(axis, point_gains))
        ):
            return None
        return lambda: make_typed_loop(robot, axis, typed_gains[0])

    def sweep(self) -> None:
        """Sweep the axis over the whole range of its inverse, with the inverse applied."""
        session, axis = self._workbench.session, self._controls.chosen
        inverse = session.inverses.applied.get(axis)
        if inverse is None:
            WaitingRequest(self._workbench, tr(NOT_PLAYED)).withdraw(
                tr("no inverse is active: apply one first")
            )
            return
        start = session.snapshot().command[axis]
        self._play(lambda: make_conditioning_sweep(self._workbench.robot, inverse.model, start))

    def play_trial(self) -> None:
        """Play decaying oscillations. The error is shown next to the errors in other modes."""
        axis = self._controls.chosen
        self._play(lambda: make_trial_motion(self._workbench.robot, axis))

    def forget_trials(self) -> None:
        """Forget all trials."""
        self.trials.clear()
        self._live.clear()

    def on_event(self, event: SessionEvent) -> None:
        """Evaluate and draw a trial whose playback has finished."""
        if not isinstance(event, PlaybackFinished) or event.record is None or not event.completed:
            return
        axis = self._controls.chosen
        trial = evaluate_trial(event.record, axis)
        if trial is not None:
            self.trials[trial.mode] = trial
            self._live.show_trial(trial, self._unit)

    def refresh(self, state: SessionState, no_inverse_reason: str | None) -> None:
        """Show errors and warnings, and enable the buttons.

        ``no_inverse_reason`` says why there is no inverse to apply, None if there is one.
        """
        controls, session, axis = self._controls, self._workbench.session, self._controls.chosen
        for mode, text in controls.residuals.items():
            text.setText(residual_text(self.trials.get(mode), self._unit))
        inverse_on, loop_on = axis in session.inverses.applied, axis in session.loops.applied
        controls.switch.show_meaning(tr(INVERSE_BUTTON_TEXTS[inverse_on]))
        controls.apply.show_meaning(tr(LOOP_BUTTON_TEXTS[loop_on]))
        exceedance = exceedance_text(session.inverses.find_exceedance(axis))
        at_limit = tr(AT_A_LIMIT) if axis in session.loops.limited_axes else ""
        waiting_text = self._workbench.at_rest.waiting_text
        controls.warnings.setText(" ".join(filter(None, (waiting_text, exceedance, at_limit))))
        moving_objection = None if state.activity is DeviceState.IDLE else tr("the axis is moving")
        lock_objection = translate_message(state.lock_reason) if state.lock_reason else None
        waiting_objection = self._workbench.at_rest.objection
        motion_objection = (
            lock_objection or waiting_objection or moving_objection or describe_owners(state.owners)
        )
        no_axis = None if axis else tr("the robot has no piezo in open loop")
        enable_unless(
            controls.switch,
            motion_objection or (None if inverse_on else no_inverse_reason),
            self._get_switch_tooltip(),
        )
        no_loop = session.loops.unavailable_reason or no_axis
        tooltip = tr(
            "Close a loop with these gains around the axis, or open it; the axis stays in place"
        )
        enable_unless(controls.apply, motion_objection or (None if loop_on else no_loop), tooltip)
        no_inverse = None if inverse_on else tr("no inverse is active: apply one first")
        enable_unless(controls.sweep, motion_objection or no_inverse, tr(SWEEP_TIP))
        enable_unless(
            controls.trial,
            motion_objection or no_axis,
            tr("Play 6 s of oscillations over 60 % of the range"),
        )

    def _get_switch_tooltip(self) -> str:
        if self._workbench.session.inverses.is_applied_per_tick:
            return tr("Apply the inverse to every set-point of this axis; the axis stays in place")
        return tr(
            "Apply the inverse to ends of moves, speeds and each row of a trajectory; "
            "the axis stays in place"
        )

    def _play(self, motion: Callable[[], Record]) -> None:
        session = self._workbench.session
        request = WaitingRequest(self._workbench, tr(NOT_PLAYED))
        self._workbench.at_rest.do(request, lambda: session.play(motion(), permit=request.permit))

    @property
    def _unit(self) -> str:
        axis = self._controls.chosen
        return (self._workbench.robot.unit(axis) if axis else None) or "m"
