"""Effects that are found by their entry points, built-in and from third parties."""

from importlib.metadata import EntryPoint

import pytest

from rotemina.sim.effects import (
    EffectStage,
    load_all_effects,
    load_effect,
    registry,
)
from rotemina.sim.errors import EffectError


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


def test_all_installed_effects_load_in_the_order_of_the_signal_chain():
    effects, broken = load_all_effects()
    assert broken == {}
    stages = [effect.stage for effect in effects.values()]
    assert stages == sorted(stages, key=list(EffectStage).index)


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


def test_a_third_party_effect_does_not_replace_a_built_in_one_and_is_reported(monkeypatch):
    installed = [*registry.entry_points(group=registry.GROUP)]
    third_party = EntryPoint("delay", "a_package.delay:DELAY", registry.GROUP)
    monkeypatch.setattr(registry, "entry_points", lambda group: [third_party, *installed])
    registry._find_entry_points.cache_clear()
    try:
        assert registry._find_entry_points()["delay"].value == "rotemina.sim.effects.delay:DELAY"
        assert "already has this id" in load_all_effects()[1]["delay (a_package.delay:DELAY)"]
    finally:
        registry._find_entry_points.cache_clear()


def test_an_unknown_effect_is_refused_with_the_known_ones_or_a_suggestion():
    with pytest.raises(EffectError, match="did you mean 'hysteresis'"):
        load_effect("histeresis")
    with pytest.raises(EffectError, match=r"'ether_wind'.*backlash"):
        load_effect("ether_wind")
