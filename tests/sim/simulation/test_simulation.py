"""Simulated records: equal in pieces and at once, with and without effects."""

import numpy as np
import pytest

from rotemina.sim.errors import PlantError
from rotemina.sim.plant import Perturbation
from rotemina.sim.records import PIECE_ROWS, Record, Tap, join_records
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import (
    SimulatedMachine,
    needs_all_commands,
    simulate,
)

ROBOT = load_robot("rotemina")
AXES = ("z", "zn", "thx")
EFFECTS = [
    AxisEffect(axis="z", id="friction"),
    AxisEffect(axis="z", id="backlash"),
    AxisEffect(axis="thx", id="hysteresis"),
    AxisEffect(axis="thx", id="delay", parameters={"delay": 7e-4}),
    AxisEffect(axis="zn", id="flexible_mode"),
]


def make_commands(rows=600, axes=AXES, **metadata):
    time_s = np.arange(rows) / 1000
    swing = 0.5 + 0.3 * np.sin(9.0 * time_s) * np.minimum(4.0 * time_s, 1.0)
    spans = {axis: min(ROBOT.axes[axis].span, 1e-3) for axis in axes}
    signals = {(axis, Tap.CMD): spans[axis] * swing for axis in axes}
    return Record.from_signals(time_s, signals, {axis: ROBOT.unit(axis) for axis in axes}, metadata)


def simulate_in_pieces(commands, effects, rng, rows, perturbation=None):
    simulation = SimulatedMachine(ROBOT, effects, commands.select_rows(slice(0, rows)), rng)
    pieces = []
    for start in range(0, len(commands.time_s), rows):
        piece_rows = slice(start, start + rows)
        piece_perturbation = None if perturbation is None else perturbation.part(piece_rows)
        pieces.append(
            simulation.follow(commands.select_rows(piece_rows), perturbation=piece_perturbation)
        )
    return join_records(pieces)


def make_perturbation(rows, axes):
    rng = np.random.default_rng(1)
    matrices = rng.uniform(-1.0, 1.0, (2, axes, axes)) * 1e-3
    return Perturbation(rng.normal(size=(rows, axes)), *matrices)


@pytest.mark.parametrize("rows", [1, 100, 599])
@pytest.mark.parametrize("effects", [(), EFFECTS], ids=["nominal", "effects"])
def test_a_run_in_pieces_equals_the_run_at_once(effects, rows):
    commands = make_commands()
    perturbation = make_perturbation(600, len(SimulatedMachine(ROBOT, effects, commands).axes))
    whole = simulate(ROBOT, effects, commands, np.random.default_rng(5), perturbation=perturbation)
    pieces = simulate_in_pieces(commands, effects, np.random.default_rng(5), rows, perturbation)
    assert pieces.columns == whole.columns
    for axis, tap in whole.columns:
        scale = np.ptp(whole.signal(axis, tap))
        gap = np.abs(pieces.signal(axis, tap) - whole.signal(axis, tap))
        if tap is Tap.MEAS:  # rounding may differ in a few samples
            assert np.mean(gap > 1e-9 * scale) < 0.01
        else:
            assert gap.max() < 1e-9 * scale


def test_pieces_of_the_default_size_equal_the_run_bit_for_bit():
    commands = make_commands(PIECE_ROWS + 5000, ("thx",))
    effects = [AxisEffect(axis="thx", id="hysteresis")]
    whole = simulate(ROBOT, effects, commands, np.random.default_rng(2))
    pieces = simulate_in_pieces(commands, effects, np.random.default_rng(2), PIECE_ROWS)
    assert pieces.values.tobytes() == whole.values.tobytes()
    assert pieces.time_s.tobytes() == whole.time_s.tobytes()


def test_a_lagging_clock_can_be_simulated_in_pieces():
    """Ends of pieces change the interpolation between samples, by less than 1e-3 of the lag."""
    commands = make_commands()
    effects = [AxisEffect(axis="thx", id="clock_skew", parameters={"skew": 1e4})]
    whole, pieces = (
        simulate(ROBOT, effects, commands),
        simulate_in_pieces(commands, effects, None, 100),
    )
    lag = np.ptp(whole.signal("thx", Tap.MEAS) - whole.signal("thx", Tap.REF))
    gap = np.abs(pieces.signal("thx", Tap.MEAS) - whole.signal("thx", Tap.MEAS))
    assert gap.max() < 1e-3 * lag


def test_leading_clocks_and_periodic_runs_need_all_commands():
    commands = make_commands(10)
    lagging, leading = (
        [AxisEffect(axis="thx", id="clock_skew", parameters={"skew": skew})]
        for skew in (100.0, -100.0)
    )
    assert not needs_all_commands(ROBOT, EFFECTS, commands)
    assert not needs_all_commands(ROBOT, None, commands)
    assert not needs_all_commands(ROBOT, lagging, commands)
    assert needs_all_commands(ROBOT, leading, commands)
    assert needs_all_commands(ROBOT, (), make_commands(10, history="periodic"))


def test_a_leading_clock_reads_beyond_the_end_of_a_piece():
    commands = make_commands(PIECE_ROWS + 1000, ("thx",))
    effects = [AxisEffect(axis="thx", id="clock_skew", parameters={"skew": -1e4})]
    record = simulate(ROBOT, effects, commands)
    row = PIECE_ROWS - 1  # the last row of a full piece
    ahead_s = 0.01 * commands.time_s[row]
    expected = np.interp(
        commands.time_s[row] + ahead_s, commands.time_s, record.signal("thx", Tap.REF)
    )
    assert record.signal("thx", Tap.MEAS)[row] == pytest.approx(expected, abs=1e-7)


def test_reference_noise_has_its_rms_and_is_independent_on_each_axis():
    commands = make_commands(5000)
    noise = []
    clean = simulate(ROBOT, (), commands)
    record = simulate(ROBOT, (), commands, np.random.default_rng(3))
    for axis in AXES:
        reference_noise = record.signal(axis, Tap.REF) - clean.signal(axis, Tap.REF)
        rms = 5e-9 if record.units[axis] == "m" else 1e-7
        assert reference_noise.std() == pytest.approx(rms, rel=0.05)
        noise.append(reference_noise / rms)
    assert np.abs(np.corrcoef(noise) - np.eye(3)).max() < 0.05


def test_a_perturbation_that_does_not_fit_is_refused():
    commands = make_commands(PIECE_ROWS + 10, ("zn",))  # z is simulated, too
    with pytest.raises(PlantError, match=f"it has {PIECE_ROWS + 9} rows; the commands have"):
        simulate(ROBOT, (), commands, perturbation=make_perturbation(PIECE_ROWS + 9, 2))
    with pytest.raises(PlantError, match=r"it has 1 axes; the plant has 2: z zn"):
        simulate(ROBOT, (), commands, perturbation=make_perturbation(PIECE_ROWS + 10, 1))
