"""A running penetration: its findings so far, and the resulting log entry."""

from dataclasses import asdict, dataclass, field

import numpy as np

from rotemina.app.motion.penetration.detector import Contact, ContactDetector, Noise
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.run_log import PenetrationRun, Verdict
from rotemina.app.motion.penetration.sample_feed import NONE, AxisSamples, joined
from rotemina.app.motion.penetration.thrust import ThrustMeasured, ThrustPlan
from rotemina.drivers.capture import Captured
from rotemina.sim.robot.model import Robot

_FELL = 1.0 / 3.0  # of the peak: the membrane gave way
_SURE = 6.0  # standard deviations


@dataclass(slots=True)
class Attempt:
    """Findings of a running penetration; positions are commands, m."""

    parameters: PenetrationParameters
    plan: ThrustPlan
    start: float
    started: str = ""
    began_s: float = 0.0  # host time, as all that follows but the samples' own
    phases: list[tuple[str, float]] = field(default_factory=list)
    resting: AxisSamples = NONE
    noise: Noise | None = None
    rest_offset: float = 0.0  # reading − command, at rest before the approach
    detectors: tuple[ContactDetector, ...] = ()  # of the nominal model, and of the one in use
    contact: Contact | None = None
    thrust_from: float = 0.0
    contact_height: float | None = None
    contact_offset: float | None = None  # reading − command, at rest on the membrane
    thrusting: list[AxisSamples] = field(default_factory=list)
    triggered_s: float | None = None  # device time of the latest sample before it
    captured: list[Captured] = field(default_factory=list)
    thrust: ThrustMeasured | None = None
    residual: float | None = None  # the latest, and reading − command
    offset: float = 0.0

    @property
    def side(self) -> float:
        """The sign of a contact's effect on the residual."""
        return -self.parameters.sign

    def noted(self, phase: str, now_s: float) -> None:
        """Note that a phase began."""
        self.phases.append((phase, now_s - self.began_s))

    def deviation(self) -> float | None:
        """Return the residual's change since the run began, against the motion; m."""
        if self.noise is None or self.residual is None:
            return None
        return self.side * (self.residual - self.noise.level)

    def load(self) -> float:
        """Return the distance of the axis from its target, m: since the contact, or the start.

        Only command and reading are used; no model is involved.
        """
        if self.contact_offset is not None:
            return abs(self.offset - self.contact_offset)
        return 0.0 if self.noise is None else abs(self.offset - self.rest_offset)

    def ended(
        self, robot: Robot, driver: str, verdict: Verdict, reason: str, model: str = ""
    ) -> PenetrationRun:
        """Return the log's entry; ``model`` is the id of the one in use."""
        contact, noise, plan = self.contact, self.noise, self.plan
        peak, final = self._deviations()
        return PenetrationRun(
            started=self.started,
            robot=robot.name,
            driver=driver,
            model=model,
            parameters=asdict(self.parameters),
            verdict=verdict,
            reason=reason,
            phases=tuple(self.phases),
            start=self.start,
            contact=contact.command if contact else None,
            contact_measured=contact.measured if contact else None,
            contact_height=self.contact_height,
            contact_delay_s=contact.delay_s if contact else None,
            contact_from_start=contact.from_start if contact else None,
            noise_rms=noise.rms if noise else None,
            threshold=self.detectors[0].threshold if self.detectors else None,
            planned_average_speed=plan.average_speed,
            planned_peak_speed=plan.peak_speed,
            fit_error=plan.fit_error,
            thrust=self.thrust,
            peak_deviation=peak,
            final_deviation=final,
            gave_way=self._gave_way(peak, final),
        )

    def _deviations(self) -> tuple[float | None, float | None]:
        if self.contact_offset is None or self.triggered_s is None:
            return None, None
        thrust = joined(self.thrusting).since(self.triggered_s)
        if not len(thrust):
            return None, None
        load = self.side * (thrust.measured - thrust.command - self.contact_offset)
        return float(load.max()), float(np.mean(load[-5:]))

    def _gave_way(self, peak: float | None, final: float | None) -> bool | None:
        if peak is None or final is None or self.noise is None:
            return None
        return peak - final > max(_FELL * peak, _SURE * self.noise.rms)
