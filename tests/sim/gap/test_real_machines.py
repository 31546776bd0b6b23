"""Real machines: what is named on them, and how far the gap shrinks on data that no fit saw."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.comparison.comparison import compare
from rotemina.sim.gap.compare.explanations import explain
from rotemina.sim.gap.diagnosis import Verdict
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import fit
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

pytestmark = pytest.mark.slow

LATE = {"delay", "amplifier_lag", "sensor_lag"}


def read(robot, folder, *names):
    return [read_record(folder / f"{name}.csv", robot=robot) for name in names]


def corrected(robot, effects):
    return replace(robot, effects=(*robot.effects, *effects))


def named(diagnosis, axis):
    """The sets of effects that an axis' causes are among, in their order."""
    causes = [cause for cause in diagnosis.causes if cause.axis == axis]
    return [{cause.effect, *cause.ambiguous_with} for cause in causes]


class TestBallScrew:
    """EMPS: relative error of the effort in closed loop; it is 17 % without dry friction."""

    robot = load_robot("emps")

    def effort_error(self, effects, folder, name):
        (record,) = read(self.robot, folder, name)
        taps = compare(corrected(self.robot, effects), record).taps
        return next(one.relative_error for one in taps if one.tap == "u")

    def evidence(self, folder, name, effects=()):
        return Evidence.of(corrected(self.robot, effects), "q", read(self.robot, folder, name))

    def test_friction_by_direction_is_named_and_published_figures_are_met(self, real_dir):
        diagnosis = diagnose(self.robot, read(self.robot, real_dir, "emps_train"), jobs=2)
        assert diagnosis.verdict is Verdict.EXPLAINED
        assert named(diagnosis, "q") == [{"friction"}]
        fitted = diagnosis.fitted
        assert self.effort_error(fitted, real_dir, "emps_train") <= 0.037
        assert self.effort_error(fitted, real_dir, "emps_pulses") <= 0.058
        friction, *others = fitted
        assert friction.id == "friction"
        axis, found = self.robot.axes["q"], friction.parameters
        # A re-tuned gain stays in the model only where unseen data ask for it.
        assert [one.id for one in others] in ([], ["gain_error"])
        share = 1.0 + sum(one.parameters["error"] for one in others)
        # The model's constant force is counted to the friction of the direction that it is against.
        ways = {"forward": (1.0, 20.14, 166.7), "backward": (-1.0, 20.63, 240.4)}
        for way, (sign, dry, viscous) in ways.items():
            force = found[f"coulomb_{way}"] + sign * axis.force_offset
            damping = axis.damping + found[f"viscous_{way}"]
            assert force / share == pytest.approx(dry, rel=0.10)
            assert damping / share == pytest.approx(viscous, rel=0.10)
        assert axis.mass / share == pytest.approx(95.11, rel=0.03)

    def test_friction_alike_in_both_directions(self, real_dir):
        alike = AxisEffect(axis="q", id="friction", formulation="lugre")
        fitted = explain(self.evidence(real_dir, "emps_train"), [alike]).fit.effects
        assert self.effort_error(fitted, real_dir, "emps_train") <= 0.046
        assert self.effort_error(fitted, real_dir, "emps_pulses") <= 0.064
        assert fitted[0].parameters["coulomb"] == pytest.approx(20.39, rel=0.10)
        damping = self.robot.axes["q"].damping + fitted[0].parameters["viscous"]
        assert damping == pytest.approx(203.5, rel=0.10)

    @pytest.mark.parametrize(("formulation", "most"), [("lugre", 0.055), ("stribeck", 0.048)])
    def test_a_delay_fitted_to_the_other_record(self, formulation, most, real_dir):
        friction = AxisEffect(axis="q", id="friction", formulation=formulation)
        own = explain(self.evidence(real_dir, "emps_train"), [friction]).fit.effects
        late = AxisEffect(axis="q", id="delay", parameters={"delay": 3e-4})
        found = fit(self.evidence(real_dir, "emps_pulses", own), [late]).effects
        assert self.effort_error((*own, *found), real_dir, "emps_pulses") <= most
        assert 2e-4 < found[0].parameters["delay"] < 6e-4

    def test_both_records_name_friction_and_no_backlash(self, real_dir):
        records = read(self.robot, real_dir, "emps_train", "emps_pulses")
        diagnosis = diagnose(self.robot, records, jobs=2)
        first, *others = named(diagnosis, "q")
        assert first == {"friction"}
        assert all(one <= LATE | {"flexible_mode"} for one in others)


class TestPiezoStack:
    """PICMA: of unknown history, so that offset and memory are each record's own."""

    robot = load_robot("picma")

    def left(self, effects, folder, name):
        """Return the rms, m, that a model leaves of a record."""
        evidence = Evidence.of(self.robot, "p", read(self.robot, folder, name))
        floor = evidence.observations[0].floor[Tap.MEAS]
        return floor * float(np.sqrt(np.mean(evidence.residual(effects) ** 2)))

    def test_hysteresis_is_named_on_swings_of_one_size_and_foretells_growing_ones(self, real_dir):
        diagnosis = diagnose(self.robot, read(self.robot, real_dir, "picma_train"), jobs=2)
        first, *others = named(diagnosis, "p")
        assert first == {"hysteresis"}
        assert any(one & LATE for one in others)
        assert any("creep" in one for one in others)
        assert self.left((), real_dir, "picma_growing") > 2e-6
        assert self.left(diagnosis.fitted, real_dir, "picma_growing") <= 0.3e-6

    def test_both_records_name_hysteresis_alone_then_what_comes_late_and_creep(self, real_dir):
        records = read(self.robot, real_dir, "picma_train", "picma_growing")
        diagnosis = diagnose(self.robot, records, jobs=2)
        first, *others = named(diagnosis, "p")
        assert first == {"hysteresis"}
        # A well damped mode at 19 Hz, of nearly all the motion, is a lag of second order too.
        assert any(one & (LATE | {"flexible_mode"}) for one in others)
        assert any("creep" in one for one in others)
        (creep,) = (one for one in diagnosis.axes["p"].causes if one.effect == "creep")
        rate = next(one.value for one in creep.parameters if one.name == "rate")
        assert 0.2e-6 < rate * 46.5e-6 < 1e-6  # m a decade of time, of a move over the range


class TestSteeringMirror:
    """FSM: relative error of the readings; a linear model of each line alone leaves 4.4 %."""

    robot = load_robot("fsm")

    def error(self, effects, folder, level):
        """Return the relative error over all axes of the test records of a level, mV."""
        records = read(self.robot, folder, *(f"fsm_{level}mV_test_{n}" for n in range(3)))
        left = whole = 0.0
        for record in records:
            answer = nominal_response(corrected(self.robot, effects), record)
            for name in self.robot.axes:
                real = record.signal(name, Tap.MEAS)
                apart = real - answer.signal(name, Tap.MEAS)
                left += float(np.sum((apart - apart.mean()) ** 2))
                whole += float(np.sum((real - real.mean()) ** 2))
        return float(np.sqrt(left / whole))

    def test_coupling_and_modes_are_named_and_foretell_other_multisines(self, real_dir):
        names = [f"fsm_200mV_train_{n}" for n in range(6)]
        diagnosis = diagnose(self.robot, read(self.robot, real_dir, *names), jobs=2)
        assert diagnosis.verdict is Verdict.EXPLAINED
        for axis in self.robot.axes:
            assert sorted(named(diagnosis, axis), key=min) == [
                {"cross_coupling"},
                {"cross_coupling"},
                {"flexible_mode"},
            ]
        errors = {level: self.error(diagnosis.fitted, real_dir, level) for level in (100, 200, 300)}
        print(*(f"{level} mV: {share:.2%}" for level, share in errors.items()))
        assert errors[200] <= 0.05
        # One linear model of a loop that grows with its amplitude: no better elsewhere.
        assert errors[100] <= 0.25
        assert errors[300] <= 0.20
