"""The state of a session as the device reports it."""

from dataclasses import replace
from types import MappingProxyType

from rotemina.app.motion.live_models import ModelOutputs
from rotemina.app.motion.state import SessionState
from rotemina.drivers.abilities import Parameterised
from rotemina.drivers.driver import Driver
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import marked


def with_status(
    state: SessionState, driver: Driver, status: DeviceStatus, *, between_segments: bool
) -> SessionState:
    """Return the state with the device's own report.

    A device at rest between the segments of a move counts as moving.
    """
    fault, activity = state.fault, status.state
    if activity is DeviceState.FAULT:
        fault = status.fault or marked("engine", "the device reports a fault")
    if between_segments and activity is DeviceState.IDLE:
        activity = DeviceState.MOVING
    differences = driver.differences if isinstance(driver, Parameterised) else ()
    return replace(
        state,
        activity=activity,
        progress=status.progress,
        fault=fault,
        unhomed=status.unhomed,
        silent_s=status.silent_s,
        differences=tuple(str(one) for one in differences),
    )


def with_samples(
    state: SessionState,
    axes: tuple[str, ...],
    samples: Samples,
    answers: ModelOutputs,
    unsettled: tuple[str, ...],
    received_s: float,
) -> SessionState:
    """Return the state with the latest row of samples, if any, and of the models."""
    if not len(samples):
        return state
    return replace(
        state,
        measured=_by_axis(axes, samples.measured),
        command=_by_axis(axes, samples.command),
        model=_by_axis(axes, answers.in_use),
        nominal=_by_axis(axes, answers.nominal),
        unsettled=unsettled,
        device_time_s=float(samples.device_time_s[-1]),
        sample_host_time_s=received_s,
    )


def _by_axis(axes: tuple[str, ...], values: FloatArray) -> MappingProxyType[str, float]:
    return MappingProxyType(dict(zip(axes, values[-1].tolist(), strict=True)))
