"""The sealed self-test run by the command line: unfinished cases first, then the score."""

import sys
from argparse import Namespace
from collections.abc import Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

from rotemina.app.blind.cases import BlindError, Cases, FolderCases, GeneratedCases, check_robot
from rotemina.app.blind.classifier import classifier_for
from rotemina.app.blind.diagnosis_process import diagnose
from rotemina.app.blind.naive_methods import CONTESTANTS, contest
from rotemina.app.blind.resumable_run import BlindRun, Contest, finished
from rotemina.app.blind.weight_calibration import calibrated
from rotemina.app.files import json_text
from rotemina.sim.blind.figures_table import HALVES, page, plain_table
from rotemina.sim.blind.intervals import Figure
from rotemina.sim.blind.picture import draw_confusion
from rotemina.sim.blind.scoring import Outcome, confusion, halves, score
from rotemina.sim.errors import InputError
from rotemina.sim.gap.compare.calibration import FORMAT as CALIBRATION_FORMAT
from rotemina.sim.robot.file import load_robot
from rotemina.sim.whole_files import replaced

FORMAT = "rotemina-blind 1"
REPORTED_FROM = 1000  # seeds below are for development: what is calibrated or tuned on them
_NOT_REPORTED = f"seeds from {REPORTED_FROM} on are for reports"
_BELOW = f"calibrate on one below {REPORTED_FROM}"
_CASES = 300

Beside = list[tuple[dict[str, Any], list[Outcome]]]


def run_test(options: Namespace) -> None:
    """Run the unfinished cases, then score all."""
    _check_seed(options)
    beside = _finished_beside(options)
    cases, folder = _cases(options)
    if any(other.resolve() == folder.resolve() for other in options.beside):
        raise InputError(f"--beside {folder}: it is the folder of this run; leave it out")
    blind = BlindRun(folder, cases)
    ask = partial(diagnose, jobs=options.jobs)
    pending = [] if options.score else blind.pending(options.shard)
    others_too = _contest(options, folder) if options.naive and pending else None
    for number, name in enumerate(pending, start=1):
        blind.do(name, ask, others_too)
        print(f"{name}: done ({number} of {len(pending)})", file=sys.stderr)
    blind.open_labels()
    outcomes = blind.outcomes()
    if not outcomes:
        raise BlindError(f"{folder}: no case is done, so there is nothing to score")
    others = {title: blind.outcomes_of(name) for name, title in CONTESTANTS.items()}
    _write(options, cases, outcomes, {title: o for title, o in others.items() if o}, beside)


def _check_seed(options: Namespace) -> None:
    """Keep seeds for development and seeds that are reported apart."""
    if options.source is not None:
        return
    if options.report is not None and options.seed < REPORTED_FROM:
        raise InputError(
            f"--report with --seed {options.seed}: seeds below {REPORTED_FROM} are for "
            f"development; report cases of a seed from {REPORTED_FROM} on"
        )
    if options.calibrate is not None and options.seed >= REPORTED_FROM:
        raise InputError(f"--calibrate with --seed {options.seed}: {_NOT_REPORTED}; {_BELOW}")


def _finished_beside(options: Namespace) -> Beside:
    """Return what is done in the folders that count in the calibration as well."""
    if options.beside and options.calibrate is None:
        raise InputError("--beside goes with --calibrate; give both, or leave it out")
    found = [finished(folder) for folder in options.beside]
    for folder, (key, _) in zip(options.beside, found, strict=True):
        seed = key.get("seed", 0)
        if not isinstance(seed, int) or seed >= REPORTED_FROM:
            raise InputError(f"--beside {folder}: its seed is {seed}; {_NOT_REPORTED}; {_BELOW}")
    return found


def _contest(options: Namespace, folder: Path) -> Contest:
    """Return the naive contestants; the one that learns does so on cases of its own."""
    robot = load_robot(options.robot)
    check_robot(robot, options.robot)
    return partial(contest, classifier=classifier_for(robot, folder / "classifier.npz"))


def _cases(options: Namespace) -> tuple[Cases, Path]:
    if (options.source is None) != (options.labels is None):
        raise InputError("--from DIR and --labels FILE belong together; give both or neither")
    if options.source is not None:
        if options.cases is not None:
            raise InputError(
                "--cases: with --from, all cases of the folder are scored; leave it out"
            )
        robot = _robot(options)
        name = f"rotemina-blind-{options.source.resolve().name}"
        return FolderCases(options.source, options.labels, robot), options.folder or Path(name)
    number = _CASES if options.cases is None else options.cases
    if number < 1 or options.seed < 0:
        raise InputError(
            f"--cases {number} --seed {options.seed}: at least 1 case, no seed below 0"
        )
    second = options.generator == "second"
    name = f"rotemina-blind-{options.seed}{'-second' if second else ''}"
    cases = GeneratedCases(_robot(options), number, options.seed, second=second)
    return cases, options.folder or Path(name)


def _robot(options: Namespace) -> str:
    """Return what ``--robot`` takes, good in any folder."""
    name = str(options.robot)
    return str(Path(name).resolve()) if Path(name).is_file() else name


def _write(
    options: Namespace,
    cases: Cases,
    outcomes: list[Outcome],
    others: dict[str, list[Outcome]],
    beside: Beside,
) -> None:
    figures = score(outcomes)
    rivals = {title: _names(score(theirs)) for title, theirs in others.items()}
    counts = confusion(outcomes)
    parts = {name: score(each) for name, each in halves(outcomes).items() if each}
    text = json_text(_document(cases, outcomes, figures, rivals, parts))
    # All files appear together or none.
    with ExitStack() as files:
        if options.report is not None:
            picture = options.report.with_suffix(".svg")
            files.enter_context(replaced(options.report)).write(
                page(
                    figures,
                    outcomes,
                    picture.name,
                    _origin(cases, len(outcomes)),
                    {**{HALVES[name]: each for name, each in parts.items()}, **rivals},
                ).encode("utf-8")
            )
            draw_confusion(counts, files.enter_context(replaced(picture)))
        if options.calibrate is not None:
            made = json_text(_calibration(cases, outcomes, beside))
            files.enter_context(replaced(options.calibrate)).write(made.encode("utf-8"))
        if options.json not in (None, "-"):
            files.enter_context(replaced(options.json)).write(text.encode("utf-8"))
    if options.json == "-":
        print(text)
        return
    print(plain_table(figures))
    for name, each in parts.items():
        print(f"\n{HALVES[name]}\n{plain_table(each)}")


def _calibration(cases: Cases, outcomes: Sequence[Outcome], beside: Beside) -> dict[str, Any]:
    """Return the calibration on these outcomes, and on those of the folders beside."""
    every = [*outcomes, *(one for _, found in beside for one in found)]
    return {
        "format": CALIBRATION_FORMAT,
        "cases": [dict(cases.key), *(key for key, _ in beside)],
        "done": len(every),
        **calibrated(every).as_json(),
    }


def _document(
    cases: Cases,
    outcomes: list[Outcome],
    figures: dict[str, Figure],
    rivals: dict[str, dict[str, Figure]],
    parts: dict[str, dict[str, Figure]],
) -> dict[str, Any]:
    return {
        "format": FORMAT,
        "cases": dict(cases.key),
        "asked": len(cases.names),
        "done": len(outcomes),
        "figures": _shown(figures),
        "halves": {name: _shown(each) for name, each in parts.items()},
        "naive": {title: _shown(theirs) for title, theirs in rivals.items()},
        "confusion": [
            {"truth": truth, "named": told, "number": number}
            for (truth, told), number in sorted(confusion(outcomes).items())
        ],
        "wrong": [
            {"case": o.name, "label": dict(o.label), "answer": dict(o.answer)}
            for o in outcomes
            if not o.right
        ],
    }


def _origin(cases: Cases, done: int) -> str:
    told = ", ".join(f"{key} `{value}`" for key, value in cases.key.items())
    asked = len(cases.names)
    share = f"{asked}" if done == asked else f"{done} of {asked}"
    return f"{share} cases of {told}"


def _names(figures: dict[str, Figure]) -> dict[str, Figure]:
    """Keep what tells how causes are named: naive methods predict nothing, and are not timed."""
    return {k: f for k, f in figures.items() if not k.startswith(("closure", "seconds"))}


def _shown(figures: dict[str, Figure]) -> dict[str, Any]:
    return {key: figure.as_json() for key, figure in figures.items()}
