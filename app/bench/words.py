"""Texts of the benchmark: one line per machine, and a page in Markdown."""

from collections.abc import Sequence

from rotemina.app.bench.result import (
    MAX_AMBIGUITY_SET_SIZE,
    MAX_DIAGNOSIS_S,
    MAX_RATIO_TO_BEST_FIT,
    BenchResult,
    NamedCause,
)
from rotemina.sim.messages import NO_VALUE
from rotemina.sim.units import format_percent, format_quantity

_HEADER = (
    "machine",
    "first cause",
    "sets",
    "closed on test",
    "left",
    "to beat",
    "time",
    "verdict",
)


def format_line(result: BenchResult) -> str:
    """Return the result of a machine on one line."""
    name = result.machine.name
    if result.not_run:
        return f"{name}: not run: {result.not_run}"
    _, first, sets, closed, remaining, to_beat, seconds, verdict = _format_cells(result)
    reference = f" (to beat: {to_beat})" if to_beat != "–" else ""
    return (
        f"{name}: {first}; {sets}; closed {closed} on the test records; "
        f"left {remaining}{reference}; {seconds}; {verdict}"
    )


def format_page(results: Sequence[BenchResult]) -> str:
    """Return the report page for all machines, in Markdown."""
    rows = ["| " + " | ".join(_HEADER) + " |", "|" + "---|" * len(_HEADER)]
    rows += ["| " + " | ".join(_format_cells(result)) + " |" for result in results]
    unmet = [
        f"- `{result.machine.name}`: {'; '.join(result.unmet_requirements)}."
        for result in results
        if result.unmet_requirements
    ]
    titles = [f"- `{result.machine.name}`: {result.title}." for result in results if result.title]
    known = [
        f"- `{result.machine.name}`: "
        + ", ".join(" or ".join(f"`{effect}`" for effect in effects) for effects in truth.causes)
        + "."
        for result in results
        if (truth := result.machine.truth) is not None and truth.causes
    ]
    return _PAGE_TEMPLATE.format(
        table="\n".join(rows),
        unmet="\n".join(unmet) or "Nothing: every level is reached on every machine.",
        titles="\n".join(titles),
        known="\n".join(known),
        max_ratio=MAX_RATIO_TO_BEST_FIT,
        max_set_size=MAX_AMBIGUITY_SET_SIZE,
        max_duration_s=f"{MAX_DIAGNOSIS_S:.0f}",
        met=sum(not result.unmet_requirements for result in results),
        total=len(results),
        better=sum(
            result.corrected_error is not None
            and result.to_beat is not None
            and result.corrected_error < result.to_beat
            for result in results
        ),
    )


def _format_cells(result: BenchResult) -> tuple[str, ...]:
    name = f"`{result.machine.name}`"
    if result.not_run:
        return (name, "–", "–", "–", "–", "–", "–", f"not run: {result.not_run}")
    first = _format_cause(result.causes[0]) if result.causes else "none"
    sets = ", ".join(map(_format_ambiguity_set, result.causes)) or "no cause"
    closed = format_percent(result.closed_share)
    return (
        name,
        first,
        sets,
        closed,
        _format_error(result, result.corrected_error),
        _format_error(result, result.to_beat),
        f"{result.seconds:.0f} s",
        result.verdict,
    )


def _format_cause(cause: NamedCause) -> str:
    return f"{cause.effect} on {cause.axis} ({100.0 * cause.probability:.0f} %)"


def _format_ambiguity_set(cause: NamedCause) -> str:
    return "{" + " ".join((cause.effect, *cause.ambiguous_with)) + "}"


def _format_error(result: BenchResult, value: float | None) -> str:
    if value is None:
        return NO_VALUE
    if result.is_relative:
        return format_percent(value, 2)
    return format_quantity(value, result.unit)


_PAGE_TEMPLATE = """\
# Real machines

See what `rotemina gap diagnose` finds on machines that others built and measured. This command
writes the page:

<!-- not run: needs the records of the machines, which are not part of the program -->

```sh
rotemina gap bench machines/* --report docs/real-machines.md
```

Each machine is a folder with `robot.toml`, with records `train_*.csv`, which are diagnosed, and
`test_*.csv`, which are not used for any fit, and with `truth.toml`, which lists the known causes.
You can run the command on your own folders:

```toml
causes = [["friction", "backlash"]]  # each set: effects that these records cannot distinguish
also = ["gain_error"]                # effects that may be named, but need not be
tap = "meas"                         # the signal that is compared
relative = false                     # true if to_beat is a relative error
to_beat = 1.45e-3                    # error of a plain fit on the test records, SI
```

{table}

*Sets*: each cause together with the effects that cannot be distinguished from it. *Closed on
test*: the share of the gap's power above the noise floor that the corrected model explains on the
test records. *Left*: the rms error of the corrected model on the test records, or its relative
error. For positions the mean is removed, and the memory of earlier motion is fitted in each
record. *To beat*: the same error for a plain output-error or least-squares fit. *Time*: duration
of the diagnosis.

## What is not reached

A diagnosis meets the requirements if all of these hold: its first cause is a known one; every
known cause is named, or is in a set of at most {max_set_size} effects or of effects known to be
indistinguishable; the error left is at most {max_ratio} × the figure to beat; and it takes at most
{max_duration_s} s. {met} of {total} diagnoses meet them. {better} of {total} leave less than the
figure to beat.

{unmet}

## The machines

{titles}

Known causes:

{known}
"""
