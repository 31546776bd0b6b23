"""Text of the bench: one line per machine, and a page."""

from collections.abc import Sequence

from rotemina.app.bench.result import LARGEST_SET, LONGEST_S, MOST_OVER, NamedCause, Result
from rotemina.sim.quantities import NOTHING, amount, percent

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


def line(result: Result) -> str:
    """Return one line about a machine."""
    name = result.machine.name
    if result.not_run:
        return f"{name}: not run: {result.not_run}"
    _, first, sets, closed, left, to_beat, seconds, verdict = _cells(result)
    beside = f" (to beat: {to_beat})" if to_beat != "–" else ""
    return (
        f"{name}: {first}; {sets}; closed {closed} on the test record; left {left}{beside}; "
        f"{seconds}; {verdict}"
    )


def page(results: Sequence[Result]) -> str:
    """Return the page on machines, in Markdown."""
    rows = ["| " + " | ".join(_HEADER) + " |", "|" + "---|" * len(_HEADER)]
    rows += ["| " + " | ".join(_cells(result)) + " |" for result in results]
    missing = [
        f"- `{result.machine.name}`: {'; '.join(result.not_reached)}."
        for result in results
        if result.not_reached
    ]
    titles = [f"- `{one.machine.name}`: {one.title}." for one in results if one.title]
    known = [
        f"- `{one.machine.name}`: "
        + ", ".join(" or ".join(f"`{effect}`" for effect in each) for each in truth.causes)
        + "."
        for one in results
        if (truth := one.machine.truth) is not None and truth.causes
    ]
    return _PAGE.format(
        table="\n".join(rows),
        missing="\n".join(missing) or "Nothing: every level is reached on every machine.",
        titles="\n".join(titles),
        known="\n".join(known),
        over=MOST_OVER,
        largest=LARGEST_SET,
        longest=f"{LONGEST_S:.0f}",
        reached=sum(not one.not_reached for one in results),
        number=len(results),
        below=sum(
            one.left is not None and one.to_beat is not None and one.left < one.to_beat
            for one in results
        ),
    )


def _cells(result: Result) -> tuple[str, ...]:
    name = f"`{result.machine.name}`"
    if result.not_run:
        return (name, "–", "–", "–", "–", "–", "–", f"not run: {result.not_run}")
    first = _effect(result.causes[0]) if result.causes else "none"
    sets = ", ".join(map(_set, result.causes)) or "no cause"
    closed = percent(result.closed)
    return (
        name,
        first,
        sets,
        closed,
        _figure(result, result.left),
        _figure(result, result.to_beat),
        f"{result.seconds:.0f} s",
        result.verdict,
    )


def _effect(cause: NamedCause) -> str:
    return f"{cause.effect} on {cause.axis} ({100.0 * cause.probability:.0f} %)"


def _set(cause: NamedCause) -> str:
    return "{" + " ".join((cause.effect, *cause.ambiguous_with)) + "}"


def _figure(result: Result, value: float | None) -> str:
    if value is None:
        return NOTHING
    if result.is_relative:
        return percent(value, 2)
    return amount(value, result.unit)


_PAGE = """\
# Real machines

See what `rotemina gap diagnose` finds on machines that others built and measured. This command
makes the page:

<!-- not run: needs the records of the machines, which are no part of the program -->

```sh
rotemina gap bench machines/* --report docs/real-machines.md
```

Each machine is a folder with `robot.toml`, records `train_*.csv` that are diagnosed and
`test_*.csv` that no fit sees, and `truth.toml`: what is known of it. You can run the command on
your own folders:

```toml
causes = [["friction", "backlash"]]  # in each set, effects that these records do not distinguish
also = ["gain_error"]                # effects that are right if named, but not required
tap = "meas"                         # the tap that is compared
relative = false                     # whether to_beat is a relative error
to_beat = 1.45e-3                    # what a plain fit leaves on the test records, SI
```

{table}

*Sets*: each cause with the effects not distinguishable from it. *Closed*: share of the gap's
power above the noise floor, on the test records. *Left*: rms remainder of the corrected model on
the test records, or the relative error; for positions without the mean, and with the memory of
earlier motion free in each record. *To beat*: the same figure of a plain output-error or
least-squares fit. *Time*: of the diagnosis.

## What is not reached

A diagnosis meets the requirements if its first cause is a known one, every known cause is named or
in a set of at most {largest} (or of effects known to be indistinguishable), at most {over} × the
figure to beat is left, and it takes at most {longest} s. That holds for {reached} of {number};
{below} of {number} are below the figure to beat.

{missing}

## The machines

{titles}

Known of them:

{known}
"""
