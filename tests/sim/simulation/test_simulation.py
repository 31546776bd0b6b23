"""Simulated records: piece by piece as at once, whatever sits on the machine."""

import numpy as np
import pytest

from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.perturbation import Perturbation
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.record_pieces import PIECE_ROWS, join_records
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import Simulation, needs_whole, simulate

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
    return Record.from_signals(time_s, signals, {a: ROBOT.unit(a) for a in axes}, metadata)


def in_pieces(commands, effects, rng, rows, perturbation=None):
    simulation = Simulation(ROBOT, effects, commands.part(slice(0, rows)), rng)
    pieces = []
    for start in range(0, len(commands.time_s), rows):
        own = slice(start, start + rows)
        shaken = None if perturbation is None else perturbation.part(own)
        pieces.append(simulation.follow(commands.part(own), perturbation=shaken))
    return join_records(pieces)


def shaking(rows, axes):
    rng = np.random.default_rng(1)
    matrices = rng.uniform(-1.0, 1.0, (2, axes, axes)) * 1e-3
    return Perturbation(rng.normal(size=(rows, axes)), *matrices)


@pytest.mark.parametrize("rows", [1, 7, 100, 599])
@pytest.mark.parametrize("effects", [(), EFFECTS], ids=["nominal", "effects"])
def test_a_run_in_pieces_is_the_run_at_once(effects, rows):
    commands = make_commands()
    shaken = shaking(600, len(Simulation(ROBOT, effects, commands).axes))
    whole = simulate(ROBOT, effects, commands, np.random.default_rng(5), perturbation=shaken)
    pieces = in_pieces(commands, effects, np.random.default_rng(5), rows, shaken)
    assert pieces.columns == whole.columns
    for axis, tap in whole.columns:
        scale = np.ptp(whole.signal(axis, tap))
        gap = np.abs(pieces.signal(axis, tap) - whole.signal(axis, tap))
        if tap is Tap.MEAS:  # rounding may fall to the other side now and then
            assert np.mean(gap > 1e-9 * scale) < 0.01
        else:
            assert gap.max() < 1e-9 * scale


def test_pieces_of_the_usual_size_are_the_whole_to_the_last_bit():
    commands = make_commands(PIECE_ROWS + 5000, ("thx",))
    effects = [AxisEffect(axis="thx", id="hysteresis")]
    whole = simulate(ROBOT, effects, commands, np.random.default_rng(2))
    pieces = in_pieces(commands, effects, np.random.default_rng(2), PIECE_ROWS)
    assert pieces.values.tobytes() == whole.values.tobytes()
    assert pieces.time_s.tobytes() == whole.time_s.tobytes()


@pytest.mark.parametrize("rows", [100, 300])
def test_a_clock_that_lags_is_followed_in_pieces(rows):
    """Ends of pieces bend the motion between samples; it is interpolated alike within 1e-3."""
    commands = make_commands()
    effects = [AxisEffect(axis="thx", id="clock_skew", parameters={"skew": 1e4})]
    whole, pieces = simulate(ROBOT, effects, commands), in_pieces(commands, effects, None, rows)
    lag = np.ptp(whole.signal("thx", Tap.MEAS) - whole.signal("thx", Tap.REF))
    gap = np.abs(pieces.signal("thx", Tap.MEAS) - whole.signal("thx", Tap.MEAS))
    assert gap.max() < 1e-3 * lag


def test_what_needs_all_commands_at_once():
    commands = make_commands(10)
    lag, lead = (
        [AxisEffect(axis="thx", id="clock_skew", parameters={"skew": skew})]
        for skew in (100.0, -100.0)
    )
    assert not needs_whole(ROBOT, EFFECTS, commands)
    assert not needs_whole(ROBOT, None, commands)
    assert not needs_whole(ROBOT, lag, commands)
    assert needs_whole(ROBOT, lead, commands)
    assert needs_whole(ROBOT, (), make_commands(10, history="periodic"))


def test_a_clock_that_leads_reads_beyond_the_end_of_a_piece():
    commands = make_commands(PIECE_ROWS + 1000, ("thx",))
    effects = [AxisEffect(axis="thx", id="clock_skew", parameters={"skew": -1e4})]
    record = simulate(ROBOT, effects, commands)
    row = PIECE_ROWS - 1  # where a piece would end, were it cut
    ahead_s = 0.01 * commands.time_s[row]
    truth = np.interp(
        commands.time_s[row] + ahead_s, commands.time_s, record.signal("thx", Tap.REF)
    )
    assert record.signal("thx", Tap.MEAS)[row] == pytest.approx(truth, abs=1e-7)


def test_the_reference_is_as_noisy_on_every_axis_and_differs():
    commands = make_commands(5000)
    noise = []
    clean = simulate(ROBOT, (), commands)
    record = simulate(ROBOT, (), commands, np.random.default_rng(3))
    for axis in AXES:
        own = record.signal(axis, Tap.REF) - clean.signal(axis, Tap.REF)
        rms = 5e-9 if record.units[axis] == "m" else 1e-7
        assert own.std() == pytest.approx(rms, rel=0.05)
        noise.append(own / rms)
    assert np.abs(np.corrcoef(noise) - np.eye(3)).max() < 0.05


def test_a_perturbation_that_does_not_fit_is_refused():
    commands = make_commands(PIECE_ROWS + 10, ("zn",))  # z comes with it
    with pytest.raises(PlantError, match=f"it has {PIECE_ROWS + 9} rows; the commands have"):
        simulate(ROBOT, (), commands, perturbation=shaking(PIECE_ROWS + 9, 2))
    with pytest.raises(PlantError, match=r"it has 1 axes; the plant has 2: z zn"):
        simulate(ROBOT, (), commands, perturbation=shaking(PIECE_ROWS + 10, 1))
