"""The check of effects: correct effects pass it, and it finds the faults of wrong ones."""

import textwrap
from importlib.metadata import EntryPoint

import pytest

from rotemina.sim.effects import registry
from rotemina.sim.errors import EffectError
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import check_effect

# Checks of these effects take seconds.
SLOW_EFFECTS = {"amplifier_lag", "contact", "cross_coupling", "flexible_mode", "hysteresis"}
SLOW_EFFECTS |= {"static_nonlinearity"}
INSTALLED = [
    pytest.param(name, marks=[pytest.mark.slow] if name in SLOW_EFFECTS else [])
    for name in registry.load_all_effects()[0]
]

# Formulations that no value of their parameters removes.
LASTING_FORMULATIONS = {("slew_limit", "hard"), ("slew_limit", "soft"), ("lost_steps", "overload")}

MODULE = """
import numpy as np
from rotemina.sim.effects import Effect, Formulation
from rotemina.sim.effects import EffectParameter as Parameter
from rotemina.sim.effects import EffectStage as Stage
from rotemina.sim.effects import EffectTrait as Trait
from rotemina.sim.effects import ForceFunction as Force
from rotemina.sim.effects import InputFunction as Drive
from rotemina.sim.effects import PositionFunction as Motion
from rotemina.sim.effects import ReadingFunction as Reading

SIZE = Parameter("size", "how much", "", -0.5, 0.5, 0.1)
POSITIVE = Parameter("size", "how much", "", 0.0, 0.5, 0.1)
CURVE = {Trait.MEMORYLESS, Trait.RATE_INDEPENDENT, Trait.READING_ONLY}


def effect(acts, *traits, parameters=(SIZE,), stage=Stage.SENSOR, kinds=("piezo",), **fields):
    presets = dict(name="one", equation="y = f(x)", source="a book", parameters=parameters)
    form = Formulation(**(presets | fields), acts=acts, traits=frozenset(traits))
    return Effect(
        id="other", title="Other", summary="Something else.", stage=stage,
        kinds=frozenset(kinds), formulations=(form,),
    )


def bent(x, other, t, h, a, b, p, s):
    return x * (1.0 + p[0] * np.sin(1000.0 * x))


def late(x, other, t, h, a, b, p, s):
    s[0] += (x - s[0]) * (1.0 - np.exp(-h / (1e-3 + abs(p[0]))))
    return s[0]


def wild(x, other, t, h, a, b, p, s):
    for i in range(100000):
        s[i] = x
    return x

def far(x, other, t, h, a, b, p, s):
    s[1] = x
    return x + p[0] * s[1]


def deep(x, other, t, h, a, b, p, s):
    return x + p[0] * x + p[1] * x


def divided(x, other, t, h, a, b, p, s):
    return x * p[0] / np.sqrt(p[0])


def dice(x, other, t, h, a, b, p, s):
    return x + p[0] * 1e-6 * np.random.normal()


def chance(x, other, t, h, a, b, p, s):
    return x + p[0] * 1e-6 * a


def sudden(x, other, t, h, a, b, p, s):
    return x + 1e-6 if p[0] > 0.0 else x


def biased(x, other, t, h, a, b, p, s):
    return x + p[0] * 1e-6 * (a + 1.0)


def counting(x, other, t, h, a, b, p, s):
    s[0] += 1.0
    return x + p[0] * 1e-9 * s[0]


def play(x, other, t, h, a, b, p, s):
    s[0] = max(x - 1e-4 * p[0], min(x + 1e-4 * p[0], s[0]))
    return s[0]


def lead(x, other, t, h, a, b, p, s):
    s[0] = max(x - 1e-4 * p[0], min(x + 1e-4 * p[0], s[0]))
    return 2.0 * x - s[0]


def push(x, other, t, h, a, b, p, s):
    return 1000.0 * p[0] * other


def idle(x, other, t, h, a, b, p, s):
    return x


def drift(x, other, t, h, a, b, p, s):
    return x + 1e-5 * p[0] * np.sin(50.0 * t) * (1.0 + 100.0 * x)


GOOD = effect(Reading(step=bent), *CURVE)
GOOD_DRIVE = effect(Drive(step=play, states=1), Trait.RATE_INDEPENDENT, Trait.DISSIPATIVE,
                    stage=Stage.ACTUATOR, parameters=(POSITIVE,))
GOOD_RANDOM = effect(Reading(step=chance, random=True), Trait.RANDOM, Trait.READING_ONLY)
NOT_LINEAR = effect(Reading(step=bent), Trait.LINEAR)
NOT_READING = effect(Motion(step=bent), Trait.READING_ONLY)
NOT_MEMORYLESS = effect(Motion(step=play, states=1), Trait.MEMORYLESS, parameters=(POSITIVE,))
NOT_TRANSIENT = effect(Reading(step=bent), Trait.TRANSIENT)
NOT_RATE_INDEPENDENT = effect(Reading(step=late, states=1), Trait.RATE_INDEPENDENT)
NOT_POSITION = effect(Motion(step=play, states=1), Trait.LOCKED_TO_POSITION, parameters=(POSITIVE,))
NOT_TIME = effect(Reading(step=drift), Trait.LOCKED_TO_TIME)
NOT_DISSIPATIVE = effect(Drive(step=lead, states=1), Trait.DISSIPATIVE, stage=Stage.ACTUATOR,
                   parameters=(POSITIVE,))
NOT_DISSIPATIVE_FORCE = effect(Force(step=push), Trait.DISSIPATIVE, stage=Stage.MECHANICS,
                         kinds=("stepper",))
NOT_RANDOM = effect(Reading(step=bent, random=True), Trait.RANDOM)
UNDECLARED_RANDOM = effect(Reading(step=chance, random=True))
BIASED = effect(Reading(step=biased, random=True), Trait.RANDOM)
IMPURE = effect(Reading(step=dice))
WILD = effect(Reading(step=wild, states=1))
OVERRUN = effect(Reading(step=far, states=1))
DEEP = effect(Reading(step=deep))
NAN = effect(Reading(step=divided), parameters=(POSITIVE,))
FORGETS = effect(Drive(step=counting, states=1), stage=Stage.ACTUATOR)
RESTLESS = effect(Reading(step=counting, states=1))
SUDDEN = effect(Reading(step=sudden), parameters=(POSITIVE,))
IDLE = effect(Reading(step=idle))
BAD_PRESET = effect(Reading(step=bent), parameters=(Parameter("size", "how much", "", 0, 1, 2),))
BAD_UNIT = effect(Reading(step=bent), parameters=(Parameter("size", "it", "furlong", 0, 1, 1),))
BAD_NAME = effect(Reading(step=bent), parameters=(Parameter("enabled", "it", "", 0, 1, 1),))
TWICE = effect(Reading(step=bent), parameters=(SIZE, SIZE))
NO_SOURCE = effect(Reading(step=bent), source=" ")
RAISES = effect(Reading(step=bent), prepare=lambda values, facts: 1 / 0)
"""

INCOMPLETE = "formulation description is complete"
FAULTS = {
    "NOT_LINEAR": "trait linear",
    "NOT_READING": "trait reading only",
    "NOT_MEMORYLESS": "trait memoryless",
    "NOT_TRANSIENT": "trait transient",
    "NOT_RATE_INDEPENDENT": "trait rate-independent",
    "NOT_POSITION": "trait locked to position",
    "NOT_TIME": "trait locked to time",
    "NOT_DISSIPATIVE": "trait dissipative",
    "NOT_DISSIPATIVE_FORCE": "trait dissipative",
    "NOT_RANDOM": "differs from seed to seed",
    "UNDECLARED_RANDOM": "is not random",
    "BIASED": "is absent without a seed",
    "IMPURE": "repeats with the same seed",
    "OVERRUN": "leaves other memory alone",
    "DEEP": "stays within its memory",
    "WILD": "stays within its memory",
    "NAN": "stays finite at presets and bounds",
    "FORGETS": "keeps its memory when read",
    "RESTLESS": "starts at rest",
    "SUDDEN": "starts smoothly from zero",
    "IDLE": "has an effect",
    **dict.fromkeys(("BAD_PRESET", "BAD_UNIT", "BAD_NAME", "TWICE", "NO_SOURCE"), INCOMPLETE),
    "RAISES": "can be simulated",
    "MISSING": "can be loaded",
}
ROBOT = load_robot("rotemina")


@pytest.fixture(scope="module")
def other_package(tmp_path_factory):
    """Folder of an installed third-party package: a module and its entry points."""
    folder = tmp_path_factory.mktemp("site")
    (folder / "other_effects.py").write_text(textwrap.dedent(MODULE), "utf-8")
    metadata_dir = folder / "other_effects-1.0.dist-info"
    metadata_dir.mkdir()
    (metadata_dir / "METADATA").write_text(
        "Metadata-Version: 2.1\nName: other-effects\nVersion: 1.0\n"
    )
    (metadata_dir / "entry_points.txt").write_text(
        "[rotemina.effects]\nother = other_effects:GOOD\n"
    )
    return folder


@pytest.fixture
def install_other(other_package, monkeypatch):
    """Return a function that installs an effect of the third-party module as ``other``."""
    monkeypatch.syspath_prepend(str(other_package))

    def install(name):
        point = EntryPoint("other", f"other_effects:{name}", registry.GROUP)
        monkeypatch.setattr(registry, "_find_entry_points", lambda: {"other": point})
        registry.load_effect.cache_clear()

    yield install
    registry.load_effect.cache_clear()


def get_failed_checks(report):
    return {check.name for check in report.failures}


@pytest.mark.parametrize("effect_id", INSTALLED)
def test_an_installed_effect_passes_the_check(effect_id):
    report = check_effect(effect_id)
    assert report.passed, "\n".join(map(str, report.failures))
    names = {check.name for check in report.checks}
    assert {"stays finite at presets and bounds", "gives the same in pieces"} <= names
    not_removed = {
        (effect_id, check.formulation)
        for check in report.checks
        if check.name == "is absent at zero" and check.passed is None
    }
    assert not_removed <= LASTING_FORMULATIONS


def test_an_effect_is_found_by_the_entry_point_of_another_package(other_package, monkeypatch):
    monkeypatch.syspath_prepend(str(other_package))
    registry._find_entry_points.cache_clear()
    try:
        assert {"other", "delay"} <= set(registry.list_effect_ids())
        assert check_effect("other").passed
    finally:
        registry._find_entry_points.cache_clear()
        registry.load_effect.cache_clear()


@pytest.mark.parametrize("name", ["GOOD", "GOOD_DRIVE", "GOOD_RANDOM"])
def test_a_correct_third_party_effect_passes(name, install_other):
    install_other(name)
    report = check_effect("other")
    assert not report.failures
    assert {check.place for check in report.checks} >= {"RoTeMiNa thx", "PICMA P-885.91 p"}


@pytest.mark.parametrize(("name", "check"), FAULTS.items())
def test_the_fault_of_an_effect_is_found(name, check, install_other):
    install_other(name)
    report = check_effect("other", [ROBOT])
    assert not report.passed
    assert check in get_failed_checks(report)
    assert all(failure.note for failure in report.failures)


def test_a_wrong_trait_is_the_only_thing_that_fails(install_other):
    install_other("NOT_LINEAR")
    assert get_failed_checks(check_effect("other", [ROBOT])) == {"trait linear"}


def test_time_is_measured_by_the_injected_clock():
    ticks = iter(range(1000))
    report = check_effect("sensor_gain", [ROBOT], clock=lambda: float(next(ticks)))
    assert get_failed_checks(report) == {"is fast enough to be fitted"}
    assert "is fast enough to be fitted" not in {
        check.name for check in check_effect("sensor_gain", [ROBOT]).checks
    }


def test_a_robot_without_a_suitable_axis_is_reported_but_no_failure():
    report = check_effect("hysteresis", [load_robot("emps")])
    assert report.passed
    assert {check.name for check in report.checks if check.passed is None} == {
        "has a suitable axis"
    }


def test_an_unknown_effect_is_refused():
    with pytest.raises(EffectError, match="there is no effect 'nope'"):
        check_effect("nope")
