"""``rotemina excite``: make a test motion within the limits of the robot."""

import argparse
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path

from rotemina.app.cli.terminal import (
    add_max_speed,
    add_robot,
    load_selected_robot,
    print_model,
    require_speed_limits,
    with_max_speeds,
)
from rotemina.sim.errors import ExcitationRequestError
from rotemina.sim.excitation import (
    EXCITATION_KINDS,
    Excitation,
    ExcitationKind,
    excite,
    parse_axis_amount,
)
from rotemina.sim.messages import MessageWording, message
from rotemina.sim.records import write_record
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_exact

OptionReader = Callable[[str, str, str], tuple[object, ...]]

# Longer descriptions of an axis are cut on the screen. The file contains them completely.
_MAX_SUMMARY_LENGTH = 150


def _make_amount_reader(unit_suffix: str) -> OptionReader:
    """Return a reader of amounts joined by ``:``, in the axis unit followed by ``unit_suffix``."""
    return lambda text, axis, unit: tuple(
        parse_axis_amount(part, axis, unit + unit_suffix) for part in text.split(":")
    )


def _make_number_reader(unit: str = "") -> OptionReader:
    return lambda text, _axis, _unit: tuple(_parse_number(part, unit) for part in text.split(":"))


def _read_count(text: str, _axis: str, _unit: str) -> tuple[int, ...]:
    return (_parse_integer(text),)


def _make_choice_reader(*names: str) -> OptionReader:
    def read(text: str, _axis: str, _unit: str) -> tuple[str]:
        if text not in names:
            raise ExcitationRequestError(
                message("cli", "{text} is not one of {names}").fill(
                    text=repr(text[:40]), names=", ".join(names)
                )
            )
        return (text,)

    return read


def _parse_number(text: str, unit: str) -> float:
    try:
        return float(text.strip().removesuffix(unit))
    except ValueError:
        advice = f"a number of {unit}" if unit else "a number"
        raise ExcitationRequestError(
            message("cli", "{text} is not {advice}").fill(text=repr(text[:40]), advice=advice)
        ) from None


def _parse_integer(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise ExcitationRequestError(
            message("cli", "{text} is not an integer").fill(text=repr(text[:40]))
        ) from None


@dataclass(frozen=True)
class ExcitationOption:
    """An option that may have a different value for each axis, and the parameters that it sets.

    With ``takes_many``, the option takes any number of values, all for its first parameter.
    """

    option: str
    names: tuple[str, ...]
    read: OptionReader
    metavar: str
    help: str
    takes_many: bool = False

    def parse_values(self, text: str, axis: str, unit: str) -> dict[str, object]:
        """Parse the text of the option; return the value of each parameter by name."""
        try:
            values = self.read(text, axis, unit)
        except ExcitationRequestError as error:
            raise ExcitationRequestError(
                message("cli", "--{option}: {error}").fill(option=self.option, error=str(error))
            ) from None
        if self.takes_many:
            return {self.names[0]: values}
        if len(values) != len(self.names):
            raise ExcitationRequestError(
                message("cli", "--{option}: {text}; write it as {metavar}").fill(
                    option=self.option, text=repr(text[:40]), metavar=self.metavar
                )
            )
        return dict(zip(self.names, values, strict=True))


EXCITATION_OPTIONS = (
    ExcitationOption(
        "amplitude",
        ("amplitude",),
        _make_amount_reader(""),
        "5um",
        "each way from the middle; % of the range",
    ),
    ExcitationOption(
        "offset",
        ("offset",),
        _make_amount_reader(""),
        "50%",
        "middle of the motion; % of the range",
    ),
    ExcitationOption(
        "frequency",
        ("frequency_hz",),
        _make_number_reader("Hz"),
        "HZ",
        "frequency of the wave, or clock of the PRBS",
    ),
    ExcitationOption(
        "band",
        ("low_hz", "high_hz"),
        _make_number_reader("Hz"),
        "LOW:HIGH",
        "band of chirp or multisine, Hz",
    ),
    ExcitationOption(
        "duration",
        ("duration_s",),
        _make_number_reader("s"),
        "S",
        "duration, rounded to whole periods",
    ),
    ExcitationOption(
        "period", ("period_s",), _make_number_reader("s"), "S", "period of the multisine"
    ),
    ExcitationOption(
        "detection", ("detection",), _read_count, "N", "leave out one odd line in N; 0: none"
    ),
    ExcitationOption(
        "slope", ("slope",), _make_number_reader(), "P", "multisine amplitudes proportional to f^P"
    ),
    ExcitationOption(
        "spacing",
        ("spacing",),
        _make_choice_reader("log", "linear"),
        "log|linear",
        "frequency spacing of the chirp",
    ),
    ExcitationOption("order", ("order",), _read_count, "N", "PRBS of 2^N - 1 chips"),
    ExcitationOption("levels", ("levels",), _read_count, "N", "levels of the staircase"),
    ExcitationOption("hold", ("hold_s",), _make_number_reader("s"), "S", "rest between moves"),
    ExcitationOption("rise", ("rise_s",), _make_number_reader("s"), "S", "rise time of a step"),
    ExcitationOption(
        "jerk", ("jerk",), _make_amount_reader("/s3"), "1m/s3", "jerk limit of a step"
    ),
    ExcitationOption("cycles", ("cycles",), _read_count, "N", "repetitions of the steps"),
    ExcitationOption(
        "speeds",
        ("speeds",),
        _make_amount_reader("/s"),
        "1mm/s:20%",
        "speeds of sweeps, joined by ':'; % of the speed limit",
        takes_many=True,
    ),
)
EXCITATION_SWITCHES = {
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
    parser.add_argument("kind", metavar="KIND", help=", ".join(EXCITATION_KINDS))
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE")
    add_robot(parser)
    parser.add_argument("--axes", metavar="x,thx", help="axes that move (default: all)")
    for option in EXCITATION_OPTIONS:
        # argparse formats help texts with the operator %.
        help_text = option.help.replace("%", "%%")
        parser.add_argument(f"--{option.option}", metavar=option.metavar, help=help_text)
    add_max_speed(parser)
    for name, meaning in EXCITATION_SWITCHES.items():
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
    """Make and write the trajectory, and print its description with all reductions."""
    robot = load_selected_robot(options)
    plan = _make_plan(robot, options)
    robot = with_max_speeds(options, robot, list(plan))
    require_speed_limits(options, robot, list(plan))
    excitation = excite(
        robot,
        plan,
        rate_hz=options.rate,
        seed=options.seed,
        strict=options.strict,
    )
    write_record(excitation.record, options.output)
    print_model(options, robot.name)
    print(f"{options.output}: {_format_summary(excitation, options.wording)}")
    return 0


def _make_plan(robot: Robot, options: argparse.Namespace) -> dict[str, ExcitationKind]:
    if options.kind not in EXCITATION_KINDS:
        raise ExcitationRequestError(
            message("cli", "unknown kind {kind}; use one of {names}").fill(
                kind=repr(options.kind[:40]), names=", ".join(EXCITATION_KINDS)
            )
        )
    names = list(robot.axes) if options.axes is None else _split_list(options.axes)
    for name in names:
        if name not in robot.axes:
            raise ExcitationRequestError(
                message(
                    "cli", "axis {name}: robot {robot_name} has no such axis; use one of {names}"
                ).fill(name=repr(name), robot_name=repr(robot.name), names=", ".join(robot.axes))
            )
    given_options = _collect_given_options(options, names)
    return {
        name: _make_kind(options, given_options, name, robot.unit(name) or "m") for name in names
    }


def _collect_given_options(
    options: argparse.Namespace, names: list[str]
) -> list[tuple[ExcitationOption, dict[str | None, str]]]:
    """Return the given options, each with its text by axis; the key None means all other axes."""
    parameter_names = {field.name for field in fields(EXCITATION_KINDS[options.kind])}
    given_options = [
        option for option in EXCITATION_OPTIONS if getattr(options, option.option) is not None
    ]
    invalid_options = [
        option.option for option in given_options if not parameter_names.issuperset(option.names)
    ]
    invalid_options += [
        name
        for name in EXCITATION_SWITCHES
        if getattr(options, name) is not None and name not in parameter_names
    ]
    if invalid_options:
        valid_options = [
            f"--{option.option}"
            for option in EXCITATION_OPTIONS
            if parameter_names.issuperset(option.names)
        ]
        valid_options += [f"--{name}" for name in EXCITATION_SWITCHES if name in parameter_names]
        raise ExcitationRequestError(
            message("cli", "{kind} has no --{refused}; it takes {names}").fill(
                kind=options.kind, refused=invalid_options[0], names=" ".join(valid_options)
            )
        )
    return [
        (option, _split_by_axis(option, getattr(options, option.option), names))
        for option in given_options
    ]


def _split_by_axis(option: ExcitationOption, text: str, names: list[str]) -> dict[str | None, str]:
    texts: dict[str | None, str] = {}
    for part in _split_list(text):
        axis, equals, value = part.partition("=")
        key = axis.strip() if equals else None
        if key is not None and key not in names:
            raise ExcitationRequestError(
                message("cli", "--{option}: axis {key} is not one of those that move").fill(
                    option=option.option, key=repr(key)
                )
            )
        if key in texts:
            raise ExcitationRequestError(
                message("cli", "--{option}: {text} has two values for an axis").fill(
                    option=option.option, text=repr(text[:40])
                )
            )
        texts[key] = value.strip() if equals else part
    return texts


def _make_kind(
    options: argparse.Namespace,
    given_options: list[tuple[ExcitationOption, dict[str | None, str]]],
    axis: str,
    unit: str,
) -> ExcitationKind:
    values: dict[str, object] = {}
    for option, text_by_axis in given_options:
        text = text_by_axis.get(axis, text_by_axis.get(None))
        if text is not None:
            values |= option.parse_values(text, axis, unit)
    switches = {name: getattr(options, name) for name in EXCITATION_SWITCHES}
    values |= {name: value for name, value in switches.items() if value is not None}
    return EXCITATION_KINDS[options.kind](**values)


def _split_list(text: str) -> list[str]:
    return [part.strip() for part in text.split(",") if part.strip()]


def _format_summary(excitation: Excitation, wording: MessageWording) -> str:
    record = excitation.record
    text = message("cli", "{rows} rows, {duration} at {rate}").fill(
        rows=len(record.time_s),
        duration=format_exact(record.duration_s, "s"),
        rate=format_exact(float(record.metadata["rate_hz"]), "Hz"),
    )
    if record.period_samples is not None:
        text = message("cli", "{summary}, period {rows} rows").fill(
            summary=text, rows=record.period_samples
        )
    lines = [wording.format_message(text)]
    for axis in record.axes:
        value = record.metadata[f"excitation {axis}"]
        if len(value) > _MAX_SUMMARY_LENGTH:
            value = f"{value[:_MAX_SUMMARY_LENGTH]} …"
        lines.append(f"  {axis}: {value}")
    changed = message("cli", "changed: {what}")
    lines += [
        f"  {wording.format_message(changed.fill(what=change.message))}"
        for change in excitation.adjustments
    ]
    return "\n".join(lines)
