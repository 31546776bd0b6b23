"""``rotemina effect``: the catalogue as its users read it, and the check with its exit status."""

from importlib.metadata import EntryPoint

import pytest

from rotemina.app.cli.main import main
from rotemina.sim.effects import registry

BROKEN = """
from rotemina.sim.effects.formulation import (
    EVERY_KIND, Effect, Formulation, Parameter, Reading, Stage, Trait
)


def bent(x, other, t, h, a, b, p, s):
    return x + p[0] * x * x


WRONG = Effect(
    id="wrong", title="Wrong", summary="Not what it says.", stage=Stage.SENSOR, kinds=EVERY_KIND,
    formulations=(
        Formulation(
            name="square", equation="y = x + k x²", source="nowhere",
            parameters=(Parameter("k", "curvature", "1/q", 0.0, 1.0, 0.5),),
            acts=Reading(step=bent), traits=frozenset({Trait.LINEAR}),
        ),
    ),
)
"""


@pytest.fixture
def wrong(tmp_path, monkeypatch):
    """A plugin whose effect is not linear although it says so, beside one that is missing."""
    (tmp_path / "wrong_effect.py").write_text(BROKEN, "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    points = {
        "wrong": EntryPoint("wrong", "wrong_effect:WRONG", registry.GROUP),
        "lost": EntryPoint("lost", "no_such_module:LOST", registry.GROUP),
        "sensor_gain": EntryPoint(
            "sensor_gain", "rotemina.sim.effects.sensor_gain:SENSOR_GAIN", registry.GROUP
        ),
    }
    monkeypatch.setattr(registry, "_points", lambda: points)
    registry.effect_named.cache_clear()
    yield
    registry.effect_named.cache_clear()


@pytest.mark.parametrize("command", [["effect"], ["effect", "list"]])
def test_list_has_a_line_for_each_effect(command, capsys):
    assert main(command) == 0
    lines = capsys.readouterr().out.splitlines()
    delay = next(line for line in lines if line.startswith("delay "))
    assert delay.split() == ["delay", "electronics", "force,", "piezo,", "stepper", "Delay"]
    places = {line.split()[0]: number for number, line in enumerate(lines)}
    assert places["delay"] < places["hysteresis"] < places["friction"] < places["sensor_gain"]


def test_list_says_what_cannot_be_loaded_and_why(wrong, capsys):
    assert main(["effect", "list"]) == 0
    assert (
        "left out: effect 'lost': no_such_module:LOST cannot be imported" in capsys.readouterr().out
    )


def test_show_has_equations_sources_and_figures_on_the_axes_of_a_robot(capsys):
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


def test_show_leaves_out_axes_that_cannot_carry_it(capsys):
    assert main(["effect", "show", "hysteresis", "--robot", "rotemina"]) == 0
    text = capsys.readouterr().out
    assert "x, y, z" not in text
    assert "thx, thy" in text


def test_check_passes_with_status_0(capsys):
    assert main(["effect", "check", "sensor_gain", "clock_skew"]) == 0
    first, second = capsys.readouterr().out.splitlines()
    assert first.split()[:2] == ["sensor_gain", "passed"]
    assert second.split()[:2] == ["clock_skew", "passed"]


def test_check_fails_with_status_1_and_says_where(wrong, capsys):
    assert main(["effect", "check", "--robot", "rotemina"]) == 1
    out = capsys.readouterr().out
    assert "sensor_gain             passed" in out
    assert "wrong                   FAILED" in out
    assert "lost                    FAILED" in out
    (found,) = [line for line in out.splitlines() if "RoTeMiNa thx" in line]
    assert "trait linear" in found
    assert "(bound 1e-06)  superposition does not hold" in found


def test_verbose_shows_every_check_with_value_and_bound(capsys):
    assert main(["effect", "check", "sensor_gain", "--robot", "picma", "--verbose"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) > 12
    (pieces,) = [line for line in lines if "in pieces is as at once" in line]
    assert pieces.split()[:4] == ["ok", "proportional", "PICMA", "P-885.91"]
    assert "(bound 1e-09)" in pieces


@pytest.mark.parametrize(
    "arguments",
    [["check", "nope"], ["show", "nope"], ["check", "delay", "--robot", "no_such_robot"]],
)
def test_bad_input_is_one_line_and_status_2(arguments, capsys):
    assert main(["effect", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert len(captured.err.splitlines()) == 1
    assert arguments[-1] in captured.err


def test_what_fits_no_axis_is_not_said_to_have_passed(capsys):
    assert main(["effect", "check", "hysteresis", "--robot", "emps"]) == 0
    said = capsys.readouterr().out
    assert "NOT TRIED: it fits no axis" in said
    assert main(["effect", "check", "delay", "--robot", "emps"]) == 0
    assert "NOT TRIED" not in capsys.readouterr().out
