"""Effects that are found by their entry points, built-in and from third parties."""

from importlib.metadata import EntryPoint

import pytest

from rotemina.sim.effects import (
    EffectStage,
    list_effect_ids,
    load_all_effects,
    load_effect,
    registry,
)
from rotemina.sim.errors import EffectError

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

# By the letters of the catalogue: P piezo, S stepper, F force.
KINDS = {
    "P": "slew_limit hysteresis creep stiffness_nonlinearity",
    "S": "lost_steps microstep_error",
    "PF": "saturation",
    "SF": "backlash leadscrew_error friction encoder_interpolation",
}
LETTERS = {"P": "piezo", "S": "stepper", "F": "force"}


def make_entry_points(*pairs):
    return {name: EntryPoint(name, value, registry.GROUP) for name, value in pairs}


@pytest.fixture
def install_only(monkeypatch):
    """Return a function that replaces the installed entry points."""

    def install(*pairs):
        monkeypatch.setattr(registry, "_find_entry_points", lambda: make_entry_points(*pairs))
        load_effect.cache_clear()

    yield install
    load_effect.cache_clear()


def test_all_effects_of_the_catalogue_load():
    effects, broken = load_all_effects()
    assert broken == {}
    assert set(CATALOGUE) <= set(effects)


def test_effects_are_in_the_order_of_the_signal_chain():
    stages = [effect.stage for effect in load_all_effects()[0].values()]
    assert stages == sorted(stages, key=list(EffectStage).index)


@pytest.mark.parametrize("effect_id", CATALOGUE)
def test_effects_act_on_the_axis_kinds_of_the_catalogue(effect_id):
    letters = next((key for key, ids in KINDS.items() if effect_id in ids.split()), "PSF")
    assert load_effect(effect_id).kinds == {LETTERS[letter] for letter in letters}


def test_an_effect_that_cannot_be_loaded_is_reported_and_left_out(install_only):
    install_only(
        ("delay", "rotemina.sim.effects.delay:DELAY"),
        ("gone", "no_such_package.effect:GONE"),
        ("stage", "rotemina.sim.effects.formulation:EffectStage"),
        ("alias", "rotemina.sim.effects.delay:DELAY"),
    )
    effects, broken = load_all_effects()
    assert list(effects) == ["delay"]
    assert "no_such_package" in broken["gone"]
    assert "is not an Effect" in broken["stage"]
    assert "has the id 'delay'" in broken["alias"]


def test_an_effect_that_ends_the_program_or_has_no_formulation_is_left_out(
    tmp_path, monkeypatch, install_only
):
    (tmp_path / "leaving_effect.py").write_text("raise SystemExit(7)")
    (tmp_path / "bare_effect.py").write_text(
        "from dataclasses import replace\n"
        "from rotemina.sim.effects.delay import DELAY\n"
        "BARE = replace(DELAY, id='bare', formulations=())\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    install_only(("leaving", "leaving_effect:ANY"), ("bare", "bare_effect:BARE"))
    effects, broken = load_all_effects()
    assert effects == {}
    assert "SystemExit" in broken["leaving"]
    assert "no formulation" in broken["bare"]


def test_an_effect_whose_id_is_taken_is_reported(monkeypatch):
    installed = [*registry.entry_points(group=registry.GROUP)]
    third_party = EntryPoint("delay", "a_package.delay:DELAY", registry.GROUP)
    monkeypatch.setattr(registry, "entry_points", lambda group: [third_party, *installed])
    registry._find_entry_points.cache_clear()
    try:
        assert "already has this id" in load_all_effects()[1]["delay (a_package.delay:DELAY)"]
    finally:
        registry._find_entry_points.cache_clear()


def test_a_misspelled_id_gets_a_suggestion():
    with pytest.raises(EffectError, match="did you mean 'hysteresis'"):
        load_effect("histeresis")


def test_an_unknown_effect_is_refused_with_the_known_ones():
    with pytest.raises(EffectError, match=r"'ether_wind'.*backlash"):
        load_effect("ether_wind")


def test_a_third_party_effect_does_not_replace_a_built_in_one(monkeypatch):
    built_in = EntryPoint("delay", "rotemina.sim.effects.delay:DELAY", registry.GROUP)
    third_party = EntryPoint("delay", "a_package.delay:DELAY", registry.GROUP)
    monkeypatch.setattr(registry, "entry_points", lambda group: [third_party, built_in])
    registry._find_entry_points.cache_clear()
    try:
        assert registry._find_entry_points()["delay"] is built_in
    finally:
        registry._find_entry_points.cache_clear()


def test_ids_are_sorted():
    assert list(list_effect_ids()) == sorted(list_effect_ids())
