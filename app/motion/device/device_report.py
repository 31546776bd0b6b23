"""The state of a session as the device reports it."""

from dataclasses import replace
from types import MappingProxyType

from rotemina.app.motion.model import ModelOutputs
from rotemina.app.motion.state import SessionState
from rotemina.drivers.abilities import ParameterStore
from rotemina.drivers.contract import (
    DeviceSamples,
    DeviceState,
    DeviceStatus,
    Driver,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import marked


def with_status(
    state: SessionState, driver: Driver, status: DeviceStatus, *, between_segments: bool
) -> SessionState:
    """Return the state updated from the device's status.

    A device at rest between two segments of a move counts as moving.
    """
    fault, activity = state.fault, status.state
    if activity is DeviceState.FAULT:
        fault = status.fault or marked("engine", "the device reports a fault")
    if between_segments and activity is DeviceState.IDLE:
        activity = DeviceState.MOVING
    differences = driver.differences if isinstance(driver, ParameterStore) else ()
    return replace(
        state,
        activity=activity,
        progress=status.progress,
        fault=fault,
        unhomed=status.unhomed,
        silent_s=status.silent_s,
        differences=tuple(str(difference) for difference in differences),
    )


def with_samples(
    state: SessionState,
    axes: tuple[str, ...],
    samples: DeviceSamples,
    model_outputs: ModelOutputs,
    unsettled_axes: tuple[str, ...],
    host_time_s: float,
) -> SessionState:
    """Return the state updated from the latest row of the samples and of the model outputs.

    ``host_time_s`` is the time at which the samples were received. Without samples the state stays
    as it is.
    """
    if not len(samples):
        return state
    return replace(
        state,
        measured=_map_by_axis(axes, samples.measured),
        command=_map_by_axis(axes, samples.command),
        model=_map_by_axis(axes, model_outputs.in_use),
        nominal=_map_by_axis(axes, model_outputs.nominal),
        unsettled=unsettled_axes,
        device_time_s=float(samples.device_time_s[-1]),
        sample_host_time_s=host_time_s,
    )


def _map_by_axis(axes: tuple[str, ...], values: FloatArray) -> MappingProxyType[str, float]:
    return MappingProxyType(dict(zip(axes, values[-1].tolist(), strict=True)))
