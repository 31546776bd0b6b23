"""Rows are held, because a model that holds rows does not explain interpolated rows."""

import numpy as np

from rotemina.drivers.mc68hc11.protocol import BeginStream
from rotemina.drivers.virtual_board.setpoint_stream import SetpointStream
from rotemina.sim.plant import Plant

TICKS_PER_ROW, TICK_S = 10, 5e-4
STEP_M = 1e-7


def interpolate_rows(rows):
    """Return the sums of a board at each tick, with a segment for each row after the first."""
    stream = SetpointStream()
    stream.begin(BeginStream(0, len(rows) - 1, 1, 16), rows[:1])
    commands = [rows[:1]]
    for distance in np.diff(rows).tolist():
        positions = stream.compute_positions(
            TICKS_PER_ROW, ((round((distance << 16) / TICKS_PER_ROW), 0),)
        )
        commands.append(stream.to_steps(positions)[:, 0].tolist())
        stream.take_segment(positions, lambda _: 0, 1e6 * TICK_S, TICKS_PER_ROW)
    return np.concatenate(commands)


def test_only_an_interpolating_model_explains_interpolated_rows(robot):
    plant, column = Plant.of(robot, only=["x"]), 0
    assert plant.axes == ("x",)

    def simulate_position(commands, period_s):
        time_s = np.arange(len(commands)) * period_s
        state = plant.find_rest_state(0.0, commands[:1])
        return plant.advance(state, time_s, commands[:, None])[0].position[:, column]

    time_s = np.arange(400) * TICKS_PER_ROW * TICK_S
    swing = np.minimum(1.0, time_s) * np.sin(2 * np.pi * 1.1 * time_s)  # to 2.8 mm/s
    rows = np.rint((0.0275 + 4e-4 * swing) / STEP_M).astype(int).tolist()
    ticks = interpolate_rows(rows)
    assert ticks[::TICKS_PER_ROW].tolist() == rows
    true_positions = simulate_position(STEP_M * ticks, TICK_S)[::TICKS_PER_ROW]
    row_positions = STEP_M * np.array(rows)
    interpolated_positions = np.interp(
        np.arange(len(ticks)) / TICKS_PER_ROW, np.arange(len(rows)), row_positions
    )
    models = {
        "holds rows": simulate_position(row_positions, TICKS_PER_ROW * TICK_S),
        "holds each row's mean": simulate_position(
            np.append((row_positions[1:] + row_positions[:-1]) / 2, row_positions[-1]),
            TICKS_PER_ROW * TICK_S,
        ),
        "interpolates rows": simulate_position(interpolated_positions, TICK_S)[::TICKS_PER_ROW],
    }
    sensor = robot.axes["x"].sensor
    errors_in_noise_floors = {
        name: float(np.sqrt(np.mean((true_positions - modelled) ** 2))) / sensor.noise_floor
        for name, modelled in models.items()
    }
    for name, error in errors_in_noise_floors.items():
        print(
            f"x interpolated at up to 2.8 mm/s, rows of 5 ms; the model {name}: "
            f"{error:.2g} noise floors"
        )
    assert errors_in_noise_floors["holds rows"] > 100.0
    assert errors_in_noise_floors["holds each row's mean"] > 3.0
    # The error comes from rounding to whole steps.
    assert errors_in_noise_floors["interpolates rows"] < 1.0
