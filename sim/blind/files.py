"""Cases as folders of record files, with their labels in a separate file."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np
import polars as pl

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.case import Case, file_unit, measured, significant
from rotemina.sim.blind.catalogue import CATALOGUE
from rotemina.sim.blind.force import ForceCase
from rotemina.sim.blind.machine import Commands
from rotemina.sim.records.writing import open_export
from rotemina.sim.robot.model import Robot

_HEAD = "# rotemina-record: 1\n# mode: {}\n"
_VOLTAGE_NOISE = 0.003
# In every hundred cases.
_MIX = {
    "healthy": 14,
    "single": 38,
    "double": 18,
    "triple": 4,
    "parameter": 8,
    "poor": 8,
    "unknown": 10,
    "force": 4,
}


def kinds(number: int, seed: int) -> Iterator[tuple[str, str | None, int]]:
    """Yield kind, effect that must be in it (or None) and seed of each of ``number`` cases."""
    deck = np.repeat(list(_MIX), list(_MIX.values()))
    rng = np.random.default_rng(seed)
    order: list[str] = []
    effects: list[str] = []
    for k in range(number):
        if not order:
            order = [str(kind) for kind in rng.permutation(deck)]
        kind = order.pop()
        effect = None
        if kind in ("single", "double"):
            if not effects:
                effects = [str(name) for name in rng.permutation(list(CATALOGUE))]
            effect = effects.pop()
        yield kind, effect, seed * 100_000 + k


def write_case(folder: Path, case: Case | ForceCase, robot: Robot) -> None:
    """Write one case's training records, and the commands and readings that are held out."""
    folder.mkdir(parents=True, exist_ok=True)
    shown: tuple[str, ...]
    withheld: tuple[str, ...]
    if isinstance(case, ForceCase):
        columns, mode = partial(_force_columns, case), "closed_loop"
        shown, withheld = ("u", "meas"), ("u", "meas")
    else:
        columns, mode = partial(_columns, case, robot), "open_loop"
        shown, withheld = case.taps, ("meas",)
    for number, commands in enumerate(case.training):
        name = f"train_{number + 1}.csv.gz"
        _write(folder / name, mode, commands, columns(commands, number, shown))
    last = columns(case.held_out, len(case.training), withheld)
    asked = {name: values for name, values in last.items() if ".cmd" in name}
    _write(folder / "test_commands.csv.gz", mode, case.held_out, asked)
    _write(folder / "test_measured.csv.gz", mode, case.held_out, last)


def _write(path: Path, mode: str, commands: Commands, columns: dict[str, FloatArray]) -> None:
    time_s = np.round(np.arange(len(commands.values)) * commands.step_s, 9)
    columns = {"t [s]": time_s, **columns}
    with open_export(str(path)) as file:
        file.write((_HEAD.format(mode) + ", ".join(columns) + "\n").encode())
        pl.DataFrame(columns).write_csv(file, include_header=False)


def _force_columns(
    case: ForceCase, commands: Commands, number: int, taps: tuple[str, ...]
) -> dict[str, FloatArray]:
    u, reading = case.signals(commands, number)
    return {
        f"{case.name}.cmd [m]": commands.values[:, 0],
        f"{case.name}.u [V]": significant(u),
        f"{case.name}.meas [m]": significant(reading, 9),
    }


def _columns(
    case: Case, robot: Robot, commands: Commands, number: int, taps: tuple[str, ...]
) -> dict[str, FloatArray]:
    columns: dict[str, FloatArray] = {}
    signals = _signals(case, robot, commands, number)
    for i, name in enumerate(case.names):
        unit, per_si = file_unit(robot, name)
        columns[f"{name}.cmd [{unit}]"] = significant(commands.values[:, i] * per_si)
        for tap in taps:
            shown, factor = ("V", 1.0) if tap == "u" else (unit, per_si)
            columns[f"{name}.{tap} [{shown}]"] = significant(signals[tap][:, i] * factor)
    return columns


def _signals(case: Case, robot: Robot, commands: Commands, number: int) -> dict[str, FloatArray]:
    response, reading = measured(case, commands, number)
    chance = np.random.default_rng((case.seed, 78, number))
    gains = [robot.axes[name].gain for name in case.names]
    noise = [robot.reference.noise_rms.of(robot.unit(name)) or 0.0 for name in case.names]
    shape = response.motion.shape
    return {
        "u": response.drive / gains + chance.normal(0.0, _VOLTAGE_NOISE, shape),
        "ref": response.motion + chance.normal(0.0, 1.0, shape) * noise,
        "meas": reading,
    }
