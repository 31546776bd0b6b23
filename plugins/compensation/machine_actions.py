"""Actions on the machine: inverse, loop, sweep, and trials."""

from collections.abc import Callable

from rotemina.app.display_units import label
from rotemina.app.motion.compensation import NamedInverse
from rotemina.app.motion.regulation import NamedRegulation, regulation_of
from rotemina.app.motion.state import Event, PlaybackFinished, SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.requests_at_rest import WaitingRequest
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.controls import Controls
from rotemina.plugins.compensation.inverse_training import Learned
from rotemina.plugins.compensation.plot_views import LiveView
from rotemina.plugins.compensation.trial_motion import Aid, Trial, trial_motion, trial_of
from rotemina.plugins.compensation.typed_gains import typed_loop
from rotemina.plugins.compensation.words import (
    APPLY,
    AT_A_LIMIT,
    SWEEP,
    SWITCH,
    exceedance_text,
    owners_text,
    residual_text,
)
from rotemina.sim.compensate.conditioning import conditioning
from rotemina.sim.compensate.judgement import NAMES
from rotemina.sim.feedback.gains import Gains
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot
from rotemina.sim.tuning.tuning_result import Tuning

NOT_PLAYED = mark("Not played: {why}. Press the button again.")


class Actuation:
    """Applies and removes inverses and loops, and runs trials.

    Parameters
    ----------
    workbench : Workbench
    controls : Controls
    live : LiveView
        Where trials are drawn.
    """

    def __init__(self, workbench: Workbench, controls: Controls, live: LiveView) -> None:
        self._workbench, self._controls, self._live = workbench, controls, live
        self.trials: dict[Aid, Trial] = {}

    def switch(self, learned: Learned | None, source: str) -> None:
        """Apply the chosen inverse to its axis, or remove the present one."""
        session, axis = self._workbench.session, self._controls.chosen
        if axis in session.inverses.applied:
            self._workbench.ask(lambda: session.inverses.remove(axis))
            return
        if learned is None or learned.axis != axis:
            text = tr("Nothing is applied: no inverse of {axis} is trained. Train one first.")
            self._workbench.notify(
                Level.WARNING, text.format(axis=label(axis)), about="compensation.md"
            )
            return
        kind = self._controls.kind.currentData()
        name = f"{NAMES[kind]}, {source}"
        inverse = NamedInverse(learned.trained.models[kind], learned.provenance.robot, name)
        self._workbench.ask(lambda: session.inverses.apply(inverse))

    def apply(self, tuning: Tuning | None, name: str) -> None:
        """Close the loop of the gains shown, if it is stable, or open the one that is closed.

        They are those of the marked point, unless others were typed.
        """
        workbench, axis = self._workbench, self._controls.chosen
        session, robot = workbench.session, workbench.robot
        if axis in session.loops.applied:
            workbench.ask(lambda: session.loops.remove(axis))
            return
        own = tuning if tuning is not None and tuning.axis == axis else None
        permit = session.permit()  # a stop while the loop is checked ends the wish

        def done(loop: NamedRegulation) -> None:
            workbench.ask(lambda: session.loops.apply(loop, permit=permit))

        make = self._loop_of(robot, axis, own, name)
        if make is not None:
            workbench.work("apply gains", tr("Checking the loop …"), make, done)

    def _loop_of(
        self, robot: Robot, axis: str, tuning: Tuning | None, name: str
    ) -> Callable[[], NamedRegulation] | None:
        """Return what makes the loop; None where what was typed is none, which is told."""
        fields = self._controls.typed
        if tuning is not None and not fields.typed:
            return lambda: regulation_of(robot, tuning, name)
        found: list[Gains] = []
        base = tuning.best.gains if tuning is not None else None
        if not self._workbench.ask(lambda: found.append(fields.gains(axis, base))):
            return None
        return lambda: typed_loop(robot, axis, found[0])

    def sweep(self) -> None:
        """Swing over all that the inverse saw, with the inverse on."""
        session, axis = self._workbench.session, self._controls.chosen
        inverse = session.inverses.applied.get(axis)
        if inverse is None:
            WaitingRequest(self._workbench, tr(NOT_PLAYED)).withdraw(
                tr("no inverse is active: apply one first")
            )
            return
        start = session.snapshot().command[axis]
        self._play(lambda: conditioning(self._workbench.robot, inverse.model, start))

    def try_it(self) -> None:
        """Play decaying swings, and show the error next to those of other states."""
        axis = self._controls.chosen
        self._play(lambda: trial_motion(self._workbench.robot, axis))

    def forget(self) -> None:
        """Forget all trials."""
        self.trials.clear()
        self._live.clear()

    def on_event(self, event: Event) -> None:
        """Take what a trial left from its record."""
        if not isinstance(event, PlaybackFinished) or event.record is None or not event.completed:
            return
        axis = self._controls.chosen
        trial = trial_of(event.record, axis)
        if trial is not None:
            self.trials[trial.by] = trial
            self._live.show_trial(trial, self._unit)

    def refresh(self, state: SessionState, other: str | None) -> None:
        """Show what is on and was left, and what can be done; ``other``: why no inverse is."""
        controls, session, axis = self._controls, self._workbench.session, self._controls.chosen
        for one, told in controls.residuals.items():
            told.setText(residual_text(self.trials.get(one), self._unit))
        inverse_on, loop_on = axis in session.inverses.applied, axis in session.loops.applied
        controls.switch.show_meaning(tr(SWITCH[inverse_on]))
        controls.apply.show_meaning(tr(APPLY[loop_on]))
        said = exceedance_text(session.inverses.exceedance(axis))
        at_limit = tr(AT_A_LIMIT) if axis in session.loops.limited else ""
        waits = self._workbench.at_rest.words
        controls.beyond.setText(" ".join(filter(None, (waits, said, at_limit))))
        moves = None if state.activity is DeviceState.IDLE else tr("the axis is moving")
        locked = spoken(state.locked) if state.locked else None
        waiting = self._workbench.at_rest.against_another
        still = locked or waiting or moves or owners_text(state.owners)
        no_axis = None if axis else tr("the robot has no piezo in open loop")
        allow(controls.switch, still or (None if inverse_on else other), self._switch_tip())
        no_loop = session.loops.unavailable or no_axis
        tip = tr(
            "Close a loop with these gains around the axis, or open it; the axis stays in place"
        )
        allow(controls.apply, still or (None if loop_on else no_loop), tip)
        no_inverse = None if inverse_on else tr("no inverse is active: apply one first")
        allow(controls.sweep, still or no_inverse, tr(SWEEP))
        allow(
            controls.trial, still or no_axis, tr("Play 6 s of oscillations over 60 % of the range")
        )

    def _switch_tip(self) -> str:
        if self._workbench.session.inverses.live:
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
