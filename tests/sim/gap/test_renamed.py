"""A plugin's effect is found as a built-in one is: each of these, copied under another id.

The records are made with the built-in effect. Then that is taken out, and a plugin brings it under
an id that nothing else knows.
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
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
ROWS, RATE_HZ = 1000, 500.0
QUICK = {
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


def on(axis, name, formulation=None, **parameters):
    source = "y" if name == "cross_coupling" else None
    return AxisEffect(
        axis=axis, id=name, formulation=formulation, parameters=parameters, from_axis=source
    )


TRUTHS = (
    on("x", "delay", delay=4e-3),
    on("zn", "amplifier_lag", time_constant=2e-3),
    on("zn", "slew_limit", rate=150.0),
    on("zn", "saturation", "soft", low_margin=20.0, high_margin=55.0, softness=0.12),
    on("zn", "quantization", step=0.6),
    on("zn", "gain_error", error=0.04),
    on("zn", "static_nonlinearity", bow=0.01),
    on("zn", "hysteresis", width=6e-6, shape=1.4),
    on("zn", "creep", rate=0.03, onset=0.05),
    on("x", "lost_steps", "event", time=0.9),
    on("x", "microstep_error", sine=2e-7, cosine=1e-7),
    on("x", "backlash", "screw", width=5e-6),
    on("x", "leadscrew_error", sine=1.5e-6, cosine=1e-6),
    on("x", "friction"),
    on("zn", "resonance_mismatch", frequency_error=0.06),
    on("zn", "flexible_mode", "appendage"),
    on("x", "cross_coupling", "static", k=0.08),
    on("zn", "stiffness_nonlinearity", hardening=0.1),
    on("zn", "contact", place=6e-5, stiffness=1.0),
    on("zn", "thermal_drift", amplitude=4e-6, time_constant=2.0),
    on("zn", "vibration", frequency=37.0, sine=5e-7),
    on("zn", "sensor_gain", error=0.03),
    on("zn", "sensor_nonlinearity", bow=1e-6),
    on("zn", "sensor_lag", time_constant=2e-3),
    on("zn", "sensor_noise"),
    on("zn", "sensor_quantization"),
    on("zn", "sensor_drift", rate=1e-7),
    on("zn", "sensor_outliers", size=5e-6),
    on("x", "encoder_interpolation", sine=1e-6, cosine=5e-7),
    on("x", "clock_skew", skew=2000.0),
)


def commands(axis: str, kind: str) -> Record:
    """Return one way to move an axis: decaying triangles, or stairs and sines."""
    own = ROBOT.axes[axis]
    time_s = np.arange(ROWS) / RATE_HZ
    away = 2 / np.pi * np.arcsin(np.sin(2 * np.pi * 1.1 * time_s)) * np.exp(-time_s / 3.0)
    stairs = np.array([0.0, 0.6, 1.0, 0.3, -0.7])[np.floor(3.0 * time_s).astype(int) % 5]
    shaken = 0.15 * np.sin(2 * np.pi * (7.0 + 18.0 * time_s) * time_s)
    ways = {
        "triangles": away,
        "both": stairs + shaken * (time_s < 1.0),
        "rests": np.where(time_s < 0.5, 0.0, 0.5),
    }
    way = ways[kind]
    share = 0.06 if own.kind == "stepper" else 0.35
    signals = {(axis, Tap.CMD): sum(own.range) / 2 + share * own.span * way}
    units = {axis: own.unit}
    if axis == "x":
        other = ROBOT.axes["y"]
        beside = 0.04 * other.span * np.sin(2 * np.pi * 0.9 * time_s + 1.0)
        signals["y", Tap.CMD], units["y"] = sum(other.range) / 2 + beside, other.unit
    return Record.from_signals(time_s, signals, units)


def recorded(truth: AxisEffect) -> list[Record]:
    """Return two records of a machine with an effect, of its axis alone but for commands."""
    rng = np.random.default_rng(3)
    kinds = ("triangles", "rests" if truth.id == "sensor_drift" else "both")
    whole = [simulate(ROBOT, [truth], commands(truth.axis, kind), rng) for kind in kinds]
    return [
        Record.from_signals(
            one.time_s,
            {
                (axis, tap): one.signal(axis, tap)
                for axis in one.axes
                for tap in Tap
                if one.has(axis, tap) and (axis == truth.axis or tap is Tap.CMD)
            },
            one.units,
        )
        for one in whole
    ]


@contextmanager
def renamed(name: str, theirs: str) -> Iterator[None]:
    """Take a built-in effect out and bring it as a plugin under another id."""
    module = ModuleType("their_effects")
    module.THEIRS = replace(registry.effect_named(name), id=theirs)
    points = [one for one in registry.entry_points(group=registry.GROUP) if one.name != name]
    points.append(EntryPoint(theirs, "their_effects:THEIRS", registry.GROUP))
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "their_effects", module)
        patch.setattr(registry, "entry_points", lambda group: points)
        forget()
        try:
            yield
        finally:
            forget()


def forget():
    registry._points.cache_clear()
    registry.effect_named.cache_clear()


def told(records, known_as):
    """Return verdict and causes with their sets, effects by the name that they are known as."""
    found = diagnose(ROBOT, records)
    causes = {
        (
            one.axis,
            known_as.get(one.effect, one.effect),
            one.from_axis,
            frozenset(known_as.get(other, other) for other in one.ambiguous_with),
        )
        for one in found.causes
    }
    return found.verdict, causes


@pytest.mark.parametrize(
    "truth", [one for one in TRUTHS if one.id in QUICK], ids=lambda one: one.id
)
def test_an_effect_under_another_id_is_named(truth):
    records = recorded(truth)
    with renamed(truth.id, "of_a_plugin"):
        verdict, causes = told(records, {})
    assert verdict == "explained"
    assert {(axis, name) for axis, name, _, _ in causes} == {(truth.axis, "of_a_plugin")}


@pytest.mark.slow
@pytest.mark.parametrize("truth", TRUTHS, ids=lambda one: one.id)
def test_an_effect_under_another_id_is_diagnosed_as_before(truth):
    records = recorded(truth)
    before = told(records, {})
    assert truth.id in {name for _, name, _, _ in before[1]}
    with renamed(truth.id, "of_a_plugin"):
        assert told(records, {"of_a_plugin": truth.id}) == before
