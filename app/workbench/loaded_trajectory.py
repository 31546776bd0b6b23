"""The loaded trajectory, with the result of its dry run and a check from the current position."""

from dataclasses import dataclass, replace

from rotemina.app.motion.limits import TipPath
from rotemina.app.motion.session import MotionSession
from rotemina.app.workbench.help_topics import explain_error
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record
from rotemina.sim.trajectory import DryRun, dry_run


@dataclass(frozen=True, slots=True, eq=False)
class TrajectoryPlan:
    """Trajectory with its dry run, in which the model in use predicts the motion.

    Attributes
    ----------
    name : str
    trajectory : Record
    dry_run : DryRun
        Result for the limits of the axes; it does not depend on the machine's position.
    model_id : str
        Identifier of the model that predicted the tracking errors.
    refusal : str
        Why the session would refuse to play it from the machine's position; "" if it would not.
    path : TipPath or None
        Path of the tip; None if there is no tip or a position is unknown.
    check_inputs : tuple
        What ``refusal`` and ``path`` depend on: :attr:`MotionSession.path_check_basis`.
    """

    name: str
    trajectory: Record
    dry_run: DryRun
    model_id: str = ""
    refusal: str = ""
    path: TipPath | None = None
    check_inputs: tuple[object, ...] = ()

    @property
    def objection(self) -> str:
        """Why its limits or the machine's position prevent playing it; "" if nothing does."""
        return self.refusal if self.dry_run.allowed else self.dry_run.objections[0]

    @classmethod
    def from_trajectory(
        cls, session: MotionSession, name: str, trajectory: Record
    ) -> "TrajectoryPlan":
        """Simulate a trajectory and check it from the current position; nothing moves.

        Raises
        ------
        TrajectoryError
            If the trajectory does not fit this robot.
        """
        model = session.model
        dry_run_result = dry_run(
            session.robot,
            trajectory,
            setpoint_period_s=session.setpoint_period_s,
            corrected=model.robot if model.is_corrected else None,
        )
        return cls(name, trajectory, dry_run_result, model.id).check_again(session)

    def check_again(self, session: MotionSession) -> "TrajectoryPlan":
        """Return the plan checked again from the machine's current position."""
        check_inputs, refusal = session.path_check_basis, ""
        if self.dry_run.checked is not None:
            try:
                session.check_play(self.dry_run.checked)
            except InputError as error:
                refusal = explain_error(error)
        path = session.tip_path(self.trajectory)
        return replace(self, refusal=refusal, path=path, check_inputs=check_inputs)
