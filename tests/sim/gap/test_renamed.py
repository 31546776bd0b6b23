"""An effect of a plugin is found like a built-in one: each effect is copied under another id.

The records are simulated with the built-in effect. Then it is removed, and a plugin provides it
under an id that the program does not know.
"""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from importlib.metadata import EntryPoint
from types import ModuleType

import numpy as np
import pytest

from rotemina.sim.effects import registry
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
ROWS, RATE_HZ = 1000, 500.0
QUICK_EFFECTS = {
    "gain_error",
    "hysteresis",
    "backlash",
    "delay",
    "saturation",
    "quantization",
    "leadscrew_error",
    "sensor_noise",
    "sensor_outliers",
    "vibration",
}


# In these short records, another effect is named in addition to these.
ACCOMPANIED_EFFECTS = {"creep", "cross_coupling"}
# Effects whose parameters these short records determine to 5 %.
ACCURATE_EFFECTS = {"gain_error", "hysteresis", "backlash", "delay", "saturation"}


def make_effect(axis, name, formulation=None, **parameters):
    source = "y" if name == "cross_coupling" else None
    return AxisEffect(
        axis=axis, id=name, formulation=formulation, parameters=parameters, from_axis=source
    )


TRUTHS = (
    make_effect("x", "delay", delay=4e-3),
    make_effect("zn", "amplifier_lag", time_constant=2e-3),
    make_effect("zn", "slew_limit", rate=150.0),
    make_effect("zn", "saturation", "soft", low_margin=20.0, high_margin=55.0, softness=0.12),
    make_effect("zn", "quantization", step=0.6),
    make_effect("zn", "gain_error", error=0.04),
    make_effect("zn", "static_nonlinearity", bow=0.01),
    make_effect("zn", "hysteresis", width=6e-6, shape=1.4),
    make_effect("zn", "creep", rate=0.03, onset=0.05),
    make_effect("x", "lost_steps", "event", time=0.9),
    make_effect("x", "microstep_error", sine=2e-7, cosine=1e-7),
    make_effect("x", "backlash", "screw", width=5e-6),
    make_effect("x", "leadscrew_error", sine=1.5e-6, cosine=1e-6),
    make_effect("x", "friction"),
    make_effect("zn", "resonance_mismatch", frequency_error=0.06),
    make_effect("zn", "flexible_mode", "appendage"),
    make_effect("x", "cross_coupling", "static", k=0.08),
    make_effect("zn", "stiffness_nonlinearity", hardening=0.1),
    make_effect("zn", "contact", place=6e-5, stiffness=1.0),
    make_effect("zn", "thermal_drift", amplitude=4e-6, time_constant=2.0),
    make_effect("zn", "vibration", frequency=37.0, sine=5e-7),
    make_effect("zn", "sensor_gain", error=0.03),
    make_effect("zn", "sensor_nonlinearity", bow=1e-6),
    make_effect("zn", "sensor_lag", time_constant=2e-3),
    make_effect("zn", "sensor_noise"),
    make_effect("zn", "sensor_quantization"),
    make_effect("zn", "sensor_drift", rate=1e-7),
    make_effect("zn", "sensor_outliers", size=5e-6),
    make_effect("x", "encoder_interpolation", sine=1e-6, cosine=5e-7),
    make_effect("x", "clock_skew", skew=2000.0),
)


def make_commands(axis: str, kind: str) -> Record:
    """Return commands of an axis: decaying triangles, steps and sines, or a step between rests."""
    description = ROBOT.axes[axis]
    time_s = np.arange(ROWS) / RATE_HZ
    triangles = 2 / np.pi * np.arcsin(np.sin(2 * np.pi * 1.1 * time_s)) * np.exp(-time_s / 3.0)
    stairs = np.array([0.0, 0.6, 1.0, 0.3, -0.7])[np.floor(3.0 * time_s).astype(int) % 5]
    sweep = 0.15 * np.sin(2 * np.pi * (7.0 + 18.0 * time_s) * time_s)
    shapes = {
        "triangles": triangles,
        "both": stairs + sweep * (time_s < 1.0),
        "rests": np.where(time_s < 0.5, 0.0, 0.5),
    }
    shape = shapes[kind]
    share = 0.06 if description.kind == "stepper" else 0.35
    signals = {(axis, Tap.CMD): sum(description.range) / 2 + share * description.span * shape}
    units = {axis: description.unit}
    if axis == "x":
        other = ROBOT.axes["y"]
        y_motion = 0.04 * other.span * np.sin(2 * np.pi * 0.9 * time_s + 1.0)
        signals["y", Tap.CMD], units["y"] = sum(other.range) / 2 + y_motion, other.unit
    return Record.from_signals(time_s, signals, units)


def simulate_records(truth: AxisEffect) -> list[Record]:
    """Return two records of a machine with an effect. Other axes have only their commands."""
    rng = np.random.default_rng(3)
    kinds = ("triangles", "rests" if truth.id == "sensor_drift" else "both")
    full_records = [
        simulate(ROBOT, [truth], make_commands(truth.axis, kind), rng) for kind in kinds
    ]
    return [
        Record.from_signals(
            record.time_s,
            {
                (axis, tap): record.signal(axis, tap)
                for axis in record.axes
                for tap in Tap
                if record.has(axis, tap) and (axis == truth.axis or tap is Tap.CMD)
            },
            record.units,
        )
        for record in full_records
    ]


@contextmanager
def replace_by_plugin(name: str, plugin_id: str) -> Iterator[None]:
    """Remove a built-in effect, and provide it by a plugin under another id."""
    module = ModuleType("their_effects")
    module.THEIRS = replace(registry.load_effect(name), id=plugin_id)
    points = [point for point in registry.entry_points(group=registry.GROUP) if point.name != name]
    points.append(EntryPoint(plugin_id, "their_effects:THEIRS", registry.GROUP))
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "their_effects", module)
        patch.setattr(registry, "entry_points", lambda group: points)
        clear_caches()
        try:
            yield
        finally:
            clear_caches()


def clear_caches():
    registry._find_entry_points.cache_clear()
    registry.load_effect.cache_clear()


def diagnose_records(records, known_as):
    """Return the diagnosis, and its causes with alternatives; ``known_as`` translates ids."""
    diagnosis = diagnose(ROBOT, records)
    causes = {
        (
            cause.axis,
            known_as.get(cause.effect, cause.effect),
            cause.from_axis,
            frozenset(known_as.get(other, other) for other in cause.ambiguous_with),
        )
        for cause in diagnosis.causes
    }
    return diagnosis, causes


@pytest.mark.parametrize(
    "truth",
    [
        pytest.param(
            truth, id=truth.id, marks=() if truth.id in QUICK_EFFECTS else pytest.mark.slow
        )
        for truth in TRUTHS
        if truth.id not in ACCOMPANIED_EFFECTS
    ],
)
def test_an_effect_under_another_id_is_named(truth):
    records = simulate_records(truth)
    with replace_by_plugin(truth.id, "of_a_plugin"):
        diagnosis, causes = diagnose_records(records, {})
    assert diagnosis.verdict == "explained"
    assert {(axis, name) for axis, name, _, _ in causes} == {(truth.axis, "of_a_plugin")}
    if truth.id in ACCURATE_EFFECTS:
        (cause,) = diagnosis.causes
        assert cause.closed > 0.95
        found = {parameter.name: parameter.value for parameter in cause.parameters}
        assert {name: found[name] for name in truth.parameters} == pytest.approx(
            truth.parameters, rel=0.05
        )


@pytest.mark.slow
@pytest.mark.parametrize(
    "truth",
    [truth for truth in TRUTHS if truth.id in ACCOMPANIED_EFFECTS],
    ids=lambda truth: truth.id,
)
def test_an_effect_under_another_id_is_diagnosed_as_before(truth):
    records = simulate_records(truth)
    built_in, built_in_causes = diagnose_records(records, {})
    assert truth.id in {name for _, name, _, _ in built_in_causes}
    with replace_by_plugin(truth.id, "of_a_plugin"):
        renamed, renamed_causes = diagnose_records(records, {"of_a_plugin": truth.id})
    assert (renamed.verdict, renamed_causes) == (built_in.verdict, built_in_causes)
