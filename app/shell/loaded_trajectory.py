"""The trajectory in hand, as a dry run found it and as the machine stands now."""

from dataclasses import dataclass, replace

from rotemina.app.motion.guard import TipPath
from rotemina.app.motion.session import MotionSession
from rotemina.app.shell.help_topics import explained
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record
from rotemina.sim.trajectory.dry_run import DryRun, dry_run


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """A trajectory with its dry run: what the model in use expects if it were played.

    Attributes
    ----------
    name : str
    trajectory : Record
    dry_run : DryRun
        Of limits of axes; it does not depend on where the machine stands.
    model_id : str
        Of the model whose tracking errors are told.
    refusal : str
        Why the session would not play it from where the machine stands; empty: it would.
    path : TipPath or None
        Where the tip would go; None where there is none, or no position is known.
    standing : tuple
        What ``refusal`` and ``path`` rest on: :attr:`MotionSession.standing`.
    """

    name: str
    trajectory: Record
    dry_run: DryRun
    model_id: str = ""
    refusal: str = ""
    path: TipPath | None = None
    standing: tuple[object, ...] = ()

    @property
    def objection(self) -> str:
        """Why it would not be played, by its limits or from where the machine stands; else ""."""
        return self.refusal if self.dry_run.allowed else self.dry_run.objections[0]

    @classmethod
    def tried(cls, session: MotionSession, name: str, trajectory: Record) -> "Plan":
        """Try a trajectory on the model, and from where the machine stands; nothing moves.

        Raises
        ------
        TrajectoryError
            If it is none for this robot.
        """
        model = session.model
        tried = dry_run(
            session.robot,
            trajectory,
            setpoint_period_s=session.setpoint_period_s,
            corrected=model.robot if model.corrected else None,
        )
        return cls(name, trajectory, tried, model.id).from_here(session)

    def from_here(self, session: MotionSession) -> "Plan":
        """Return the same as the machine stands now."""
        standing, refusal = session.standing, ""
        if self.dry_run.checked is not None:
            try:
                session.check_play(self.dry_run.checked)
            except InputError as error:
                refusal = explained(error)
        path = session.tip_path(self.trajectory)
        return replace(self, refusal=refusal, path=path, standing=standing)
