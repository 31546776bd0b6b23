"""``rotemina effect``: the catalogue of effects, and the check with its exit status."""

from importlib.metadata import EntryPoint

import pytest

from rotemina.app.cli.main import main
from rotemina.sim.effects import registry

BROKEN_EFFECT_SOURCE = """
from rotemina.sim.effects import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    ReadingFunction,
)


def bent(x, other, t, h, a, b, p, s):
    return x + p[0] * x * x


WRONG = Effect(
    id="wrong", title="Wrong", summary="Not what it says.",
    stage=EffectStage.SENSOR, kinds=EVERY_KIND,
    formulations=(
        Formulation(
            name="square", equation="y = x + k x²", source="nowhere",
            parameters=(EffectParameter("k", "curvature", "1/q", 0.0, 1.0, 0.5),),
            acts=ReadingFunction(step=bent), traits=frozenset({EffectTrait.LINEAR}),
        ),
    ),
)
"""


@pytest.fixture
def broken_plugins(tmp_path, monkeypatch):
    """Install an effect that is falsely declared linear, and one that cannot be imported."""
    (tmp_path / "wrong_effect.py").write_text(BROKEN_EFFECT_SOURCE, "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    points = {
        "wrong": EntryPoint("wrong", "wrong_effect:WRONG", registry.GROUP),
        "lost": EntryPoint("lost", "no_such_module:LOST", registry.GROUP),
        "sensor_gain": EntryPoint(
            "sensor_gain", "rotemina.sim.effects.sensor_gain:SENSOR_GAIN", registry.GROUP
        ),
    }
    monkeypatch.setattr(registry, "_find_entry_points", lambda: points)
    registry.load_effect.cache_clear()
    yield
    registry.load_effect.cache_clear()


def test_list_has_a_line_for_each_effect(capsys):
    assert main(["effect"]) == 0
    lines = capsys.readouterr().out.splitlines()
    delay = next(line for line in lines if line.startswith("delay "))
    assert delay.split() == ["delay", "electronics", "force,", "piezo,", "stepper", "Delay"]
    line_numbers = {line.split()[0]: number for number, line in enumerate(lines)}
    assert (
        line_numbers["delay"]
        < line_numbers["hysteresis"]
        < line_numbers["friction"]
        < line_numbers["sensor_gain"]
    )


def test_list_reports_effects_that_cannot_be_loaded(broken_plugins, capsys):
    assert main(["effect", "list"]) == 0
    assert (
        "left out: effect 'lost': no_such_module:LOST cannot be imported" in capsys.readouterr().out
    )


def test_show_has_equations_sources_and_values_per_axis(capsys):
    assert main(["effect", "show", "sensor_drift"]) == 0
    text = capsys.readouterr().out
    assert "formulation random_walk" in text
    assert "formulation flicker" in text
    assert "Corsini and Saletti" in text
    assert "traits: locked to time, random, reading only" in text
    lines = [" ".join(line.split()) for line in text.splitlines()]
    assert "x, y, z 70.24 nm/√s (0 m/√s to 35.12 µm/√s)" in lines
    assert "zn 24.43 nm/√s (0 m/√s to 12.22 µm/√s)" in lines
    assert any(line.startswith("thx, thy ") and "rad/√s" in line for line in lines)
    # Axes that the effect does not fit are omitted.
    assert main(["effect", "show", "hysteresis", "--robot", "rotemina"]) == 0
    text = capsys.readouterr().out
    assert "x, y, z" not in text
    assert "thx, thy" in text


def test_check_passes_with_status_0(capsys):
    assert main(["effect", "check", "sensor_gain", "clock_skew"]) == 0
    first, second = capsys.readouterr().out.splitlines()
    assert first.split()[:2] == ["sensor_gain", "passed"]
    assert second.split()[:2] == ["clock_skew", "passed"]


def test_failed_check_has_status_1_and_names_the_failure(broken_plugins, capsys):
    assert main(["effect", "check", "--robot", "rotemina"]) == 1
    out = capsys.readouterr().out
    assert "sensor_gain             passed" in out
    assert "wrong                   FAILED" in out
    assert "lost                    FAILED" in out
    (failure,) = [line for line in out.splitlines() if "RoTeMiNa thx" in line]
    assert "trait linear" in failure
    assert "(bound 1e-06)  superposition does not hold" in failure


def test_verbose_shows_every_check_with_value_and_bound(capsys):
    assert main(["effect", "check", "sensor_gain", "--robot", "picma", "--verbose"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) > 12
    (pieces,) = [line for line in lines if "gives the same in pieces" in line]
    assert pieces.split()[:4] == ["ok", "proportional", "PICMA", "P-885.91"]
    assert "(bound 1e-09)" in pieces


@pytest.mark.parametrize(
    "arguments", ["check nope", "show nope", "check delay --robot no_such_robot"]
)
def test_bad_input_is_refused(arguments, get_refusal):
    assert arguments.split()[-1] in get_refusal(f"effect {arguments}")


def test_effect_that_fits_no_axis_is_reported_as_not_tried(capsys):
    assert main(["effect", "check", "hysteresis", "--robot", "emps"]) == 0
    output = capsys.readouterr().out
    assert "NOT TRIED: it fits no axis" in output
    assert main(["effect", "check", "delay", "--robot", "emps"]) == 0
    assert "NOT TRIED" not in capsys.readouterr().out
