"""Why rows are held: what a record shows of an axis that a stream leads from row to row."""

import numpy as np

from rotemina.drivers.mc68hc11.host_messages import BeginStream
from rotemina.drivers.virtual_board.setpoint_stream import Stream
from rotemina.sim.plant.plant import Plant

TICKS, TICK_S = 10, 5e-4  # of a row
STEP = 1e-7


def led(rows):
    """Return what boards add up, tick by tick, with a segment for each row after the first."""
    stream = Stream()
    stream.begin(BeginStream(0, len(rows) - 1, 1, 16), rows[:1])
    told = [rows[:1]]
    for way in np.diff(rows).tolist():
        places = stream.places(TICKS, ((round((way << 16) / TICKS), 0),))
        told.append(stream.steps(places)[:, 0].tolist())
        stream.take(places, lambda _: 0, 1e6 * TICK_S, TICKS)
    return np.concatenate(told)


def test_only_a_model_that_leads_too_explains_an_axis_that_is_led(robot):
    plant, column = Plant.of(robot, only=["x"]), 0
    assert plant.axes == ("x",)

    def reached(commands, period_s):
        time_s = np.arange(len(commands)) * period_s
        state = plant.at_rest(0.0, commands[:1])
        return plant.advance(state, time_s, commands[:, None])[0].position[:, column]

    time_s = np.arange(400) * TICKS * TICK_S
    swing = np.minimum(1.0, time_s) * np.sin(2 * np.pi * 1.1 * time_s)  # to 2.8 mm/s
    rows = np.rint((0.0275 + 4e-4 * swing) / STEP).astype(int).tolist()
    ticks = led(rows)
    assert ticks[::TICKS].tolist() == rows
    true = reached(STEP * ticks, TICK_S)[::TICKS]
    asked = STEP * np.array(rows)
    even = np.interp(np.arange(len(ticks)) / TICKS, np.arange(len(rows)), asked)
    models = {
        "holds rows": reached(asked, TICKS * TICK_S),
        "holds each row's mean": reached(
            np.append((asked[1:] + asked[:-1]) / 2, asked[-1]), TICKS * TICK_S
        ),
        "leads too": reached(even, TICK_S)[::TICKS],
    }
    sensor = robot.axes["x"].sensor
    floors = {
        name: float(np.sqrt(np.mean((true - own) ** 2))) / sensor.noise_floor
        for name, own in models.items()
    }
    for name, gap in floors.items():
        print(f"x led at up to 2.8 mm/s, rows of 5 ms; the model {name}: {gap:.2g} noise floors")
    assert floors["holds rows"] > 100.0
    assert floors["holds each row's mean"] > 3.0
    assert floors["leads too"] < 1.0  # steps are whole
