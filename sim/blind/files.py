"""Writing of cases as folders of record files."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.case import BlindCase, get_file_unit, round_significant, simulate_record
from rotemina.sim.blind.catalogue import CATALOGUE
from rotemina.sim.blind.force import ForceCase
from rotemina.sim.blind.machine import SampledCommands
from rotemina.sim.records import open_export, write_columns
from rotemina.sim.robot import Robot

_FILE_HEAD = "# rotemina-record: 1\n# mode: {}\n"
_VOLTAGE_NOISE_V = 0.003
# Number of cases of each kind in every hundred cases.
_CASES_PER_HUNDRED = {
    "healthy": 14,
    "single": 38,
    "double": 18,
    "triple": 4,
    "parameter": 8,
    "poor": 8,
    "unknown": 10,
    "force": 4,
}


def draw_kinds(count: int, seed: int) -> Iterator[tuple[str, str | None, int]]:
    """Yield the kind, the required effect (or None) and the seed of each of ``count`` cases.

    Each effect of the catalogue is required equally often.
    """
    kinds_of_hundred = np.repeat(list(_CASES_PER_HUNDRED), list(_CASES_PER_HUNDRED.values()))
    rng = np.random.default_rng(seed)
    remaining_kinds: list[str] = []
    remaining_effects: list[str] = []
    for k in range(count):
        if not remaining_kinds:
            remaining_kinds = [str(kind) for kind in rng.permutation(kinds_of_hundred)]
        kind = remaining_kinds.pop()
        effect = None
        if kind in ("single", "double"):
            if not remaining_effects:
                remaining_effects = [str(name) for name in rng.permutation(list(CATALOGUE))]
            effect = remaining_effects.pop()
        yield kind, effect, seed * 100_000 + k


def write_case(folder: Path, case: BlindCase | ForceCase, robot: Robot) -> None:
    """Write the training records of a case, and its held-out commands and readings."""
    folder.mkdir(parents=True, exist_ok=True)
    training_taps: tuple[str, ...]
    held_out_taps: tuple[str, ...]
    if isinstance(case, ForceCase):
        make_columns, mode = partial(_make_force_columns, case), "closed_loop"
        training_taps, held_out_taps = ("u", "meas"), ("u", "meas")
    else:
        make_columns, mode = partial(_make_columns, case, robot), "open_loop"
        training_taps, held_out_taps = case.taps, ("meas",)
    for number, commands in enumerate(case.training):
        name = f"train_{number + 1}.csv.gz"
        _write_record(folder / name, mode, commands, make_columns(commands, number, training_taps))
    held_out_columns = make_columns(case.held_out, len(case.training), held_out_taps)
    command_columns = {name: values for name, values in held_out_columns.items() if ".cmd" in name}
    _write_record(folder / "test_commands.csv.gz", mode, case.held_out, command_columns)
    _write_record(folder / "test_measured.csv.gz", mode, case.held_out, held_out_columns)


def _write_record(
    path: Path, mode: str, commands: SampledCommands, columns: dict[str, FloatArray]
) -> None:
    time_s = np.round(np.arange(len(commands.values)) * commands.step_s, 9)
    columns = {"t [s]": time_s, **columns}
    with open_export(str(path)) as file:
        file.write((_FILE_HEAD.format(mode) + ", ".join(columns) + "\n").encode())
        write_columns(file, list(columns.values()))


def _make_force_columns(
    case: ForceCase, commands: SampledCommands, number: int, taps: tuple[str, ...]
) -> dict[str, FloatArray]:
    u, reading = case.simulate_signals(commands, number)
    return {
        f"{case.name}.cmd [m]": commands.values[:, 0],
        f"{case.name}.u [V]": round_significant(u),
        f"{case.name}.meas [m]": round_significant(reading, 9),
    }


def _make_columns(
    case: BlindCase, robot: Robot, commands: SampledCommands, number: int, taps: tuple[str, ...]
) -> dict[str, FloatArray]:
    columns: dict[str, FloatArray] = {}
    signals = _simulate_signals(case, robot, commands, number)
    for i, name in enumerate(case.axis_names):
        unit, per_si = get_file_unit(robot, name)
        columns[f"{name}.cmd [{unit}]"] = round_significant(commands.values[:, i] * per_si)
        for tap in taps:
            tap_unit, factor = ("V", 1.0) if tap == "u" else (unit, per_si)
            columns[f"{name}.{tap} [{tap_unit}]"] = round_significant(signals[tap][:, i] * factor)
    return columns


def _simulate_signals(
    case: BlindCase, robot: Robot, commands: SampledCommands, number: int
) -> dict[str, FloatArray]:
    response, reading = simulate_record(case, commands, number)
    rng = np.random.default_rng((case.seed, 78, number))
    gains = [robot.axes[name].gain for name in case.axis_names]
    noise = [robot.reference.noise_rms.of(robot.unit(name)) or 0.0 for name in case.axis_names]
    shape = response.motion.shape
    return {
        "u": response.drive / gains + rng.normal(0.0, _VOLTAGE_NOISE_V, shape),
        "ref": response.motion + rng.normal(0.0, 1.0, shape) * noise,
        "meas": reading,
    }
