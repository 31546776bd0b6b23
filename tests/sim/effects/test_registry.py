"""Effects found by their entry points: ours and a third party's."""

from importlib.metadata import EntryPoint

import pytest

from rotemina.sim.effects import registry
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.formulation import Stage
from rotemina.sim.effects.registry import all_effects, effect_ids, effect_named

CATALOGUE = [
    "delay",
    "amplifier_lag",
    "slew_limit",
    "saturation",
    "quantization",
    "gain_error",
    "static_nonlinearity",
    "hysteresis",
    "creep",
    "lost_steps",
    "microstep_error",
    "backlash",
    "leadscrew_error",
    "friction",
    "resonance_mismatch",
    "flexible_mode",
    "cross_coupling",
    "stiffness_nonlinearity",
    "contact",
    "thermal_drift",
    "vibration",
    "sensor_gain",
    "sensor_nonlinearity",
    "sensor_lag",
    "sensor_noise",
    "sensor_quantization",
    "sensor_drift",
    "sensor_outliers",
    "encoder_interpolation",
    "clock_skew",
]

KINDS = {  # by the spec's letters: P piezo, S stepper, F force
    "P": "slew_limit hysteresis creep stiffness_nonlinearity",
    "S": "lost_steps microstep_error",
    "PF": "saturation",
    "SF": "backlash leadscrew_error friction encoder_interpolation",
}
LETTERS = {"P": "piezo", "S": "stepper", "F": "force"}


def points(*pairs):
    return {name: EntryPoint(name, value, registry.GROUP) for name, value in pairs}


@pytest.fixture
def only(monkeypatch):
    """Let these entry points be the installed ones."""

    def install(*pairs):
        monkeypatch.setattr(registry, "_points", lambda: points(*pairs))
        effect_named.cache_clear()

    yield install
    effect_named.cache_clear()


def test_the_catalogue_is_whole_and_loads():
    found, broken = all_effects()
    assert broken == {}
    assert set(CATALOGUE) <= set(found)


def test_effects_stand_in_the_order_of_the_signal_chain():
    stages = [effect.stage for effect in all_effects()[0].values()]
    assert stages == sorted(stages, key=list(Stage).index)


@pytest.mark.parametrize("effect_id", CATALOGUE)
def test_effects_sit_on_the_kinds_of_axis_that_the_catalogue_says(effect_id):
    letters = next((key for key, ids in KINDS.items() if effect_id in ids.split()), "PSF")
    assert effect_named(effect_id).kinds == {LETTERS[letter] for letter in letters}


def test_an_effect_that_cannot_be_loaded_is_named_and_left_out(only):
    only(
        ("delay", "rotemina.sim.effects.delay:DELAY"),
        ("gone", "no_such_package.effect:GONE"),
        ("stage", "rotemina.sim.effects.formulation:Stage"),
        ("alias", "rotemina.sim.effects.delay:DELAY"),
    )
    found, broken = all_effects()
    assert list(found) == ["delay"]
    assert "no_such_package" in broken["gone"]
    assert "is not an Effect" in broken["stage"]
    assert "has the id 'delay'" in broken["alias"]


def test_an_effect_that_ends_the_program_or_has_no_formulation_is_left_out(
    tmp_path, monkeypatch, only
):
    (tmp_path / "leaving_effect.py").write_text("raise SystemExit(7)")
    (tmp_path / "bare_effect.py").write_text(
        "from dataclasses import replace\n"
        "from rotemina.sim.effects.delay import DELAY\n"
        "BARE = replace(DELAY, id='bare', formulations=())\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    only(("leaving", "leaving_effect:ANY"), ("bare", "bare_effect:BARE"))
    found, broken = all_effects()
    assert found == {}
    assert "SystemExit" in broken["leaving"]
    assert "no formulation" in broken["bare"]


def test_an_effect_whose_id_is_taken_is_told(monkeypatch):
    installed = [*registry.entry_points(group=registry.GROUP)]
    theirs = EntryPoint("delay", "a_package.delay:DELAY", registry.GROUP)
    monkeypatch.setattr(registry, "entry_points", lambda group: [theirs, *installed])
    registry._points.cache_clear()
    try:
        assert "already has this id" in all_effects()[1]["delay (a_package.delay:DELAY)"]
    finally:
        registry._points.cache_clear()


def test_a_slip_of_an_id_is_guessed():
    with pytest.raises(EffectError, match="did you mean 'hysteresis'"):
        effect_named("histeresis")


def test_an_unknown_effect_is_refused_with_the_known_ones():
    with pytest.raises(EffectError, match=r"'ether_wind'.*backlash"):
        effect_named("ether_wind")


def test_a_built_in_effect_is_not_replaced_by_a_third_partys(monkeypatch):
    ours = EntryPoint("delay", "rotemina.sim.effects.delay:DELAY", registry.GROUP)
    theirs = EntryPoint("delay", "a_package.delay:DELAY", registry.GROUP)
    monkeypatch.setattr(registry, "entry_points", lambda group: [theirs, ours])
    registry._points.cache_clear()
    try:
        assert registry._points()["delay"] is ours
    finally:
        registry._points.cache_clear()


def test_ids_are_sorted():
    assert list(effect_ids()) == sorted(effect_ids())
