"""``rotemina excite``: make a test motion that stays inside the limits of the robot."""

import argparse
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path

from rotemina.app.cli.options import (
    add_max_speed,
    add_robot,
    check_speed_limits,
    robot_of,
    tell_model,
    with_max_speeds,
)
from rotemina.sim.excitation.generator import KINDS, Excitation, Kind, excite
from rotemina.sim.excitation.quantity import ExcitationError, amount_of
from rotemina.sim.messages import Wording, message
from rotemina.sim.quantities import exact
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.model import Robot

Reader = Callable[[str, str, str], tuple[object, ...]]

_LONGEST = 150  # signs of an axis' parameters on the screen; the file has them all


def _amounts(per: str) -> Reader:
    """Read amounts that are joined by ``:``, in the axis' unit with ``per`` behind it."""
    return lambda text, axis, unit: tuple(
        amount_of(part, axis, unit + per) for part in text.split(":")
    )


def _numbers(unit: str = "") -> Reader:
    return lambda text, _axis, _unit: tuple(_number(part, unit) for part in text.split(":"))


def _counts(text: str, _axis: str, _unit: str) -> tuple[int, ...]:
    return (_count(text),)


def _choice(*names: str) -> Reader:
    def read(text: str, _axis: str, _unit: str) -> tuple[str]:
        if text not in names:
            raise ExcitationError(
                message("cli", "{text} is not one of {names}").fill(
                    text=repr(text[:40]), names=", ".join(names)
                )
            )
        return (text,)

    return read


def _number(text: str, unit: str) -> float:
    try:
        return float(text.strip().removesuffix(unit))
    except ValueError:
        advice = f"a number of {unit}" if unit else "a number"
        raise ExcitationError(
            message("cli", "{text} is not {advice}").fill(text=repr(text[:40]), advice=advice)
        ) from None


def _count(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise ExcitationError(
            message("cli", "{text} is not an integer").fill(text=repr(text[:40]))
        ) from None


@dataclass(frozen=True)
class Parameter:
    """An option whose value each axis may have of its own, and the parameters that it sets."""

    option: str
    names: tuple[str, ...]
    read: Reader
    metavar: str
    help: str
    many: bool = False

    def values(self, text: str, axis: str, unit: str) -> dict[str, object]:
        """Return what ``text`` sets, by the names of the parameters."""
        try:
            found = self.read(text, axis, unit)
        except ExcitationError as error:
            raise ExcitationError(
                message("cli", "--{option}: {error}").fill(option=self.option, error=str(error))
            ) from None
        if self.many:
            return {self.names[0]: found}
        if len(found) != len(self.names):
            raise ExcitationError(
                message("cli", "--{option}: {text}; write it as {metavar}").fill(
                    option=self.option, text=repr(text[:40]), metavar=self.metavar
                )
            )
        return dict(zip(self.names, found, strict=True))


PARAMETERS = (
    Parameter(
        "amplitude", ("amplitude",), _amounts(""), "5um", "each way from the middle; % of the range"
    ),
    Parameter("offset", ("offset",), _amounts(""), "50%", "middle of the motion; % of the range"),
    Parameter(
        "frequency",
        ("frequency_hz",),
        _numbers("Hz"),
        "HZ",
        "frequency of the wave, or clock of the PRBS",
    ),
    Parameter(
        "band", ("low_hz", "high_hz"), _numbers("Hz"), "LOW:HIGH", "band of chirp or multisine, Hz"
    ),
    Parameter(
        "duration", ("duration_s",), _numbers("s"), "S", "duration, rounded to whole periods"
    ),
    Parameter("period", ("period_s",), _numbers("s"), "S", "period of the multisine"),
    Parameter("detection", ("detection",), _counts, "N", "leave out one odd line in N; 0: none"),
    Parameter("slope", ("slope",), _numbers(), "P", "multisine amplitudes proportional to f^P"),
    Parameter(
        "spacing",
        ("spacing",),
        _choice("log", "linear"),
        "log|linear",
        "frequency spacing of the chirp",
    ),
    Parameter("order", ("order",), _counts, "N", "PRBS of 2^N - 1 chips"),
    Parameter("levels", ("levels",), _counts, "N", "levels of the staircase"),
    Parameter("hold", ("hold_s",), _numbers("s"), "S", "rest between moves"),
    Parameter("rise", ("rise_s",), _numbers("s"), "S", "rise time of a step"),
    Parameter("jerk", ("jerk",), _amounts("/s3"), "1m/s3", "jerk limit of a step"),
    Parameter("cycles", ("cycles",), _counts, "N", "repetitions of the steps"),
    Parameter(
        "speeds",
        ("speeds",),
        _amounts("/s"),
        "1mm/s:20%",
        "speeds of sweeps, joined by ':'; % of the speed limit",
        many=True,
    ),
)
SWITCHES = {
    "periodic": "end one row before the first row repeats, and mark the file as periodic",
    "growing": "let the triangle wave grow instead of decay",
}


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "excite",
        help="make a test motion that stays inside the robot's limits",
        description="Write a trajectory that excites axes of a robot. It never leaves the range, "
        "voltage, speed and acceleration of an axis; a request beyond them is reduced"
        " and reported. A value can be given per axis: --amplitude x=5um,thx=200urad",
    )
    parser.add_argument("kind", metavar="KIND", help=", ".join(KINDS))
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE")
    add_robot(parser)
    parser.add_argument("--axes", metavar="x,thx", help="axes that move (default: all)")
    for each in PARAMETERS:
        help_text = each.help.replace("%", "%%")
        parser.add_argument(f"--{each.option}", metavar=each.metavar, help=help_text)
    add_max_speed(parser)
    for name, meaning in SWITCHES.items():
        parser.add_argument(
            f"--{name}", action=argparse.BooleanOptionalAction, default=None, help=meaning
        )
    parser.add_argument(
        "--rate",
        type=float,
        metavar="HZ",
        help="rows per second (default: 4 per period of the resonance)",
    )
    parser.add_argument(
        "--seed", type=int, default=0, metavar="N", help="seed of phases and sequences"
    )
    parser.add_argument(
        "--strict", action="store_true", help="refuse what exceeds a limit instead of reducing it"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Make the trajectory, write it, and describe it and all reductions."""
    robot = robot_of(options)
    plan = _plan(robot, options)
    robot = with_max_speeds(options, robot, list(plan))
    check_speed_limits(options, robot, list(plan))
    made = excite(
        robot,
        plan,
        rate_hz=options.rate,
        seed=options.seed,
        strict=options.strict,
    )
    write_record(made.record, options.output)
    tell_model(options, robot.name)
    print(f"{options.output}: {_summary(made, options.wording)}")
    return 0


def _plan(robot: Robot, options: argparse.Namespace) -> dict[str, Kind]:
    if options.kind not in KINDS:
        raise ExcitationError(
            message("cli", "unknown kind {kind}; use one of {names}").fill(
                kind=repr(options.kind[:40]), names=", ".join(KINDS)
            )
        )
    names = list(robot.axes) if options.axes is None else _split(options.axes)
    for name in names:
        if name not in robot.axes:
            raise ExcitationError(
                message(
                    "cli", "axis {name}: robot {robot_name} has no such axis; use one of {names}"
                ).fill(name=repr(name), robot_name=repr(robot.name), names=", ".join(robot.axes))
            )
    stated = _stated(options, names)
    return {name: _kind(options, stated, name, robot.unit(name) or "m") for name in names}


def _stated(
    options: argparse.Namespace, names: list[str]
) -> list[tuple[Parameter, dict[str | None, str]]]:
    """Return the options that were given, with their texts by axis; None: of all others."""
    known = {field.name for field in fields(KINDS[options.kind])}
    given = [each for each in PARAMETERS if getattr(options, each.option) is not None]
    refused = [each.option for each in given if not known.issuperset(each.names)]
    refused += [s for s in SWITCHES if getattr(options, s) is not None and s not in known]
    if refused:
        takes = [f"--{each.option}" for each in PARAMETERS if known.issuperset(each.names)]
        takes += [f"--{name}" for name in SWITCHES if name in known]
        raise ExcitationError(
            message("cli", "{kind} has no --{refused}; it takes {names}").fill(
                kind=options.kind, refused=refused[0], names=" ".join(takes)
            )
        )
    return [(each, _by_axis(each, getattr(options, each.option), names)) for each in given]


def _by_axis(parameter: Parameter, text: str, names: list[str]) -> dict[str | None, str]:
    texts: dict[str | None, str] = {}
    for part in _split(text):
        axis, equals, value = part.partition("=")
        key = axis.strip() if equals else None
        if key is not None and key not in names:
            raise ExcitationError(
                message("cli", "--{option}: axis {key} is not one of those that move").fill(
                    option=parameter.option, key=repr(key)
                )
            )
        if key in texts:
            raise ExcitationError(
                message("cli", "--{option}: {text} has two values for an axis").fill(
                    option=parameter.option, text=repr(text[:40])
                )
            )
        texts[key] = value.strip() if equals else part
    return texts


def _kind(
    options: argparse.Namespace,
    stated: list[tuple[Parameter, dict[str | None, str]]],
    axis: str,
    unit: str,
) -> Kind:
    values: dict[str, object] = {}
    for parameter, texts in stated:
        text = texts.get(axis, texts.get(None))
        if text is not None:
            values |= parameter.values(text, axis, unit)
    switches = {name: getattr(options, name) for name in SWITCHES}
    values |= {name: value for name, value in switches.items() if value is not None}
    return KINDS[options.kind](**values)


def _split(text: str) -> list[str]:
    return [part.strip() for part in text.split(",") if part.strip()]


def _summary(made: Excitation, wording: Wording) -> str:
    record = made.record
    said = message("cli", "{rows} rows, {duration} at {rate}").fill(
        rows=len(record.time_s),
        duration=exact(record.duration_s, "s"),
        rate=exact(float(record.metadata["rate_hz"]), "Hz"),
    )
    if record.period_samples is not None:
        said = message("cli", "{summary}, period {rows} rows").fill(
            summary=said, rows=record.period_samples
        )
    lines = [wording.of(said)]
    for axis in record.axes:
        words = record.metadata[f"excitation {axis}"]
        lines.append(f"  {axis}: {words if len(words) <= _LONGEST else words[:_LONGEST] + ' …'}")
    changed = message("cli", "changed: {what}")
    lines += [f"  {wording.of(changed.fill(what=each.message))}" for each in made.adjustments]
    return "\n".join(lines)
