"""A running penetration: its measurements, and the log entry that results from them."""

from dataclasses import asdict, dataclass, field

import numpy as np

from rotemina.app.motion.penetration.detector import ContactDetector, DetectedContact, ResidualNoise
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.run_log import PenetrationRun, PenetrationVerdict
from rotemina.app.motion.penetration.sample_feed import NO_SAMPLES, AxisSamples, join_samples
from rotemina.app.motion.penetration.thrust import MeasuredThrust, ThrustPlan
from rotemina.drivers.abilities import CapturedSamples
from rotemina.sim.robot import Robot

# The membrane has given way if the deviation fell by more than this fraction of its peak, and by
# more than this many standard deviations of the noise.
_GIVE_WAY_PEAK_RATIO = 1.0 / 3.0
_GIVE_WAY_NOISE_RATIO = 6.0


@dataclass(slots=True)
class PenetrationAttempt:
    """Measurements of a running penetration; positions are commands, m."""

    parameters: PenetrationParameters
    plan: ThrustPlan
    start: float
    started: str = ""
    # All times are host times, except for those of the samples.
    began_s: float = 0.0
    phases: list[tuple[str, float]] = field(default_factory=list)
    rest_samples: AxisSamples = NO_SAMPLES
    noise: ResidualNoise | None = None
    # Reading − command at rest before the approach.
    rest_offset: float = 0.0
    # One for the nominal model, and one for the model in use if it is corrected.
    detectors: tuple[ContactDetector, ...] = ()
    contact: DetectedContact | None = None
    thrust_start: float = 0.0
    contact_height: float | None = None
    # Reading − command at rest on the membrane, before the thrust.
    contact_offset: float | None = None
    thrust_samples: list[AxisSamples] = field(default_factory=list)
    # Device time of the latest sample before the trigger.
    triggered_s: float | None = None
    captures: list[CapturedSamples] = field(default_factory=list)
    thrust: MeasuredThrust | None = None
    # Residual and reading − command of the latest sample.
    residual: float | None = None
    offset: float = 0.0

    @property
    def contact_sign(self) -> float:
        """Sign of the residual that a contact causes."""
        return -self.parameters.sign

    def note_phase(self, phase: str, now_s: float) -> None:
        """Record the beginning of a phase."""
        self.phases.append((phase, now_s - self.began_s))

    def compute_deviation(self) -> float | None:
        """Return the change of the residual since the run began, m, positive against the motion."""
        if self.noise is None or self.residual is None:
            return None
        return self.contact_sign * (self.residual - self.noise.level)

    def compute_load(self) -> float:
        """Return the amount by which ``meas − command`` has changed since the contact, m.

        Before a contact it is the change since the start. No model is involved.
        """
        if self.contact_offset is not None:
            return abs(self.offset - self.contact_offset)
        return 0.0 if self.noise is None else abs(self.offset - self.rest_offset)

    def make_run(
        self, robot: Robot, driver: str, verdict: PenetrationVerdict, reason: str, model: str = ""
    ) -> PenetrationRun:
        """Return the log entry of the run; ``model`` is the id of the model in use."""
        contact, noise, plan = self.contact, self.noise, self.plan
        peak, final = self._compute_deviations()
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
            contact_from_start=contact.was_at_start if contact else None,
            noise_rms=noise.rms if noise else None,
            threshold=self.detectors[0].threshold if self.detectors else None,
            planned_average_speed=plan.average_speed,
            planned_peak_speed=plan.peak_speed,
            fit_error=plan.fit_error,
            thrust=self.thrust,
            peak_deviation=peak,
            final_deviation=final,
            gave_way=self._has_given_way(peak, final),
        )

    def _compute_deviations(self) -> tuple[float | None, float | None]:
        """Return the peak and the final deviation during the thrust, m, if there was one."""
        if self.contact_offset is None or self.triggered_s is None:
            return None, None
        thrust = join_samples(self.thrust_samples).select_later(self.triggered_s)
        if not len(thrust):
            return None, None
        load = self.contact_sign * (thrust.measured - thrust.command - self.contact_offset)
        return float(load.max()), float(np.mean(load[-5:]))

    def _has_given_way(self, peak: float | None, final: float | None) -> bool | None:
        if peak is None or final is None or self.noise is None:
            return None
        return peak - final > max(
            _GIVE_WAY_PEAK_RATIO * peak, _GIVE_WAY_NOISE_RATIO * self.noise.rms
        )
