"""What acts on the machine: an inverse, a loop, the sweep between them, and trials of all."""

from collections.abc import Callable

from rotemina.app.motion.compensation import NamedInverse
from rotemina.app.motion.regulation import NamedRegulation, regulation_of
from rotemina.app.motion.state import Event, PlaybackFinished, SessionState
from rotemina.app.shell.controls import allow
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.compensation.controls import Controls
from rotemina.plugins.compensation.learning import Learned
from rotemina.plugins.compensation.trial import Aid, Trial, trial_motion, trial_of
from rotemina.plugins.compensation.views import LiveView
from rotemina.plugins.compensation.words import (
    APPLY,
    AT_A_LIMIT,
    NO_FRONT,
    SWEEP,
    SWITCH,
    exceedance_text,
    owners_text,
    residual_text,
)
from rotemina.sim.compensate.conditioning import conditioning
from rotemina.sim.compensate.judgement import NAMES
from rotemina.sim.records.record import Record
from rotemina.sim.tuning.result import Tuning


class Actuation:
    """Puts on and takes off, and tries.

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
        """Put the chosen inverse on its axis, or take off what is on."""
        session, axis = self._workbench.session, self._controls.chosen
        if axis in session.compensated:
            self._workbench.ask(lambda: session.uncompensate(axis))
            return
        if learned is None or learned.axis != axis:
            return
        kind = self._controls.kind.currentData()
        name = f"{NAMES[kind]}, {source}"
        inverse = NamedInverse(learned.trained.models[kind], learned.provenance.robot, name)
        self._workbench.ask(lambda: session.compensate(inverse))

    def apply(self, tuning: Tuning | None, name: str) -> None:
        """Close the loop of the marked point, if it is stable, or open the one that is closed."""
        workbench, axis = self._workbench, self._controls.chosen
        session, robot = workbench.session, workbench.robot
        if axis in session.regulated:
            workbench.ask(lambda: session.unregulate(axis))
            return
        if tuning is None or tuning.axis != axis:
            return
        permit = session.permit()  # a stop while the loop is checked ends the wish

        def done(loop: NamedRegulation) -> None:
            workbench.ask(lambda: session.regulate(loop, permit=permit))

        workbench.work(
            "apply gains",
            translate("compensation", "Checking the loop …"),
            lambda: regulation_of(robot, tuning, name),
            done,
        )

    def sweep(self) -> None:
        """Swing over all that the inverse saw, with the inverse on."""
        session, axis = self._workbench.session, self._controls.chosen
        inverse = session.compensated.get(axis)
        if inverse is not None:
            start = session.snapshot().command[axis]
            self._play(lambda: conditioning(self._workbench.robot, inverse.model, start))

    def try_it(self, begun: Callable[[], None]) -> None:
        """Play swings that fade; what is left is shown beside what other states left.

        ``begun`` is called if they are played.
        """
        axis = self._controls.chosen
        self._play(lambda: trial_motion(self._workbench.robot, axis), begun)

    def forget(self) -> None:
        """Forget all trials."""
        self.trials.clear()
        self._live.clear()

    def heard(self, event: Event) -> None:
        """Take what a trial left from its record."""
        if not isinstance(event, PlaybackFinished) or event.record is None or not event.completed:
            return
        axis = self._controls.chosen
        trial = trial_of(event.record, axis)
        if trial is not None:
            self.trials[trial.by] = trial
            self._live.show_trial(trial, self._unit)

    def refresh(self, state: SessionState, other: str | None, tuning: Tuning | None) -> None:
        """Show what is on and was left, and what can be done; ``other``: why no inverse is."""
        controls, session, axis = self._controls, self._workbench.session, self._controls.chosen
        for one, told in controls.residuals.items():
            told.setText(residual_text(self.trials.get(one), self._unit))
        inverse_on, loop_on = axis in session.compensated, axis in session.regulated
        controls.switch.setText(translate("compensation", SWITCH[inverse_on]))
        controls.apply.setText(translate("compensation", APPLY[loop_on]))
        said = exceedance_text(session.beyond_inverse(axis))
        at_limit = (
            translate("compensation", AT_A_LIMIT) if axis in session.regulation_limited else ""
        )
        controls.beyond.setText(" ".join(filter(None, (said, at_limit))))
        moves = (
            None if state.activity is DeviceState.IDLE else translate("compensation", "it moves")
        )
        locked = spoken(state.locked) if state.locked else None
        still = locked or moves or owners_text(state.owners)
        no_axis = None if axis else translate("compensation", "the robot has no piezo in open loop")
        allow(controls.switch, still or (None if inverse_on else other), self._switch_tip())
        no_loop = session.no_regulation or self._no_point(tuning)
        tip = translate(
            "compensation",
            "Close the marked point's loop around the axis, which stays in place, or open it",
        )
        allow(controls.apply, still or (None if loop_on else no_loop), tip)
        no_inverse = (
            None if inverse_on else translate("compensation", "no inverse is on: put one on first")
        )
        if inverse_on and not session.compensates_all:
            no_inverse = translate(
                "compensation", "this device sends only trajectories through the inverse"
            )
        allow(controls.sweep, still or no_inverse, translate("compensation", SWEEP))
        allow(
            controls.trial,
            still or no_axis,
            translate("compensation", "Play 6 s of swings over 60 % of the range"),
        )

    def _no_point(self, tuning: Tuning | None) -> str | None:
        """Return why no point of a front can be applied to the axis; None if one can."""
        if tuning is None:
            return translate("compensation", NO_FRONT)
        if tuning.axis == self._controls.chosen:
            return None
        text = translate("compensation", "the gains in hand are of axis {axis}")
        return text.format(axis=tuning.axis)

    def _switch_tip(self) -> str:
        if self._workbench.session.compensates_all:
            return translate(
                "compensation",
                "Every set-point of this axis goes through the inverse; the axis stays in place",
            )
        return translate(
            "compensation",
            "Played trajectories go through the inverse; single moves go as they are told",
        )

    def _play(self, motion: Callable[[], Record], begun: Callable[[], None] = lambda: None) -> None:
        session = self._workbench.session
        permit = session.permit()
        self._workbench.ask_aside(lambda: session.play(motion(), permit=permit), begun)

    @property
    def _unit(self) -> str:
        axis = self._controls.chosen
        return (self._workbench.robot.unit(axis) if axis else None) or "m"
