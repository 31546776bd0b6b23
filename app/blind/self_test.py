"""Blind self-test of the gap diagnosis, run by ``rotemina gap blind``.

It diagnoses the unfinished cases without access to their labels, then scores all cases.
"""

import sys
from argparse import Namespace
from collections.abc import Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

from rotemina.app.bench import format_difference, format_summary
from rotemina.app.blind.cases import CaseSource, FolderCaseSource, GeneratedCaseSource, check_robot
from rotemina.app.blind.classifier import load_or_train_classifier
from rotemina.app.blind.diagnosis_process import diagnose_case
from rotemina.app.blind.naive_methods import CONTESTANTS, answer_case
from rotemina.app.blind.resumable_run import AskNaiveMethods, ResumableBlindRun, read_finished_run
from rotemina.app.blind.weight_calibration import fit_calibration
from rotemina.app.errors import BlindError
from rotemina.app.settings import format_json
from rotemina.sim.blind import (
    REMAINDER_GROUP_TITLES,
    CaseOutcome,
    IntervalEstimate,
    count_confusion,
    draw_confusion,
    format_page,
    format_plain_table,
    score,
    split_by_remainder,
)
from rotemina.sim.errors import InputError
from rotemina.sim.files import replace_file
from rotemina.sim.gap.compare import FORMAT as CALIBRATION_FORMAT
from rotemina.sim.robot_files import load_robot

FIGURES_FORMAT = "rotemina-blind 1"
# Smaller seeds are for development, that is, for calibration and tuning.
MIN_REPORTED_SEED = 1000
_SEED_RULE = f"seeds from {MIN_REPORTED_SEED} on are for reports"
_SEED_ADVICE = f"calibrate with a seed below {MIN_REPORTED_SEED}"
_DEFAULT_CASE_COUNT = 300

#: For each run, the key that identifies its cases, and their outcomes.
FinishedRuns = list[tuple[dict[str, Any], list[CaseOutcome]]]


def run_self_test(options: Namespace) -> None:
    """Diagnose the unfinished cases, unless ``--score`` is given, then score all cases."""
    _check_seed(options)
    additional_runs = _read_additional_runs(options)
    cases, folder = _make_case_source(options)
    if any(other.resolve() == folder.resolve() for other in options.beside):
        raise InputError(f"--beside {folder}: this is the folder of the run itself; leave it out")
    blind_run = ResumableBlindRun(folder, cases)
    diagnose = partial(diagnose_case, jobs=options.jobs)
    pending = [] if options.score else blind_run.list_pending(options.shard)
    naive_methods = _make_naive_methods(options, folder) if options.naive and pending else None
    diagnose_otherwise = (
        None if options.against is None else partial(diagnose, program=options.against)
    )
    for number, name in enumerate(pending, start=1):
        blind_run.run_case(name, diagnose, naive_methods, diagnose_otherwise)
        print(f"{name}: done ({number} of {len(pending)})", file=sys.stderr)
    # Labels that share a file have stayed sealed until here.
    blind_run.open_labels()
    outcomes = blind_run.read_outcomes()
    if not outcomes:
        raise BlindError(
            f"{folder}: no case is finished, so there is nothing to score; run it without --score"
        )
    naive_outcomes = {
        title: blind_run.read_outcomes_of(name) for name, title in CONTESTANTS.items()
    }
    _write_results(
        options,
        cases,
        outcomes,
        {title: answered for title, answered in naive_outcomes.items() if answered},
        additional_runs,
    )
    if options.against is not None:
        _print_comparison(blind_run, options.json == "-")


def _print_comparison(blind_run: ResumableBlindRun, is_stdout_used: bool) -> None:
    """Print where the answers of two versions differ, and the figures of the other one."""
    output = sys.stderr if is_stdout_used else sys.stdout
    comparisons = blind_run.compare_versions()
    figures = score(blind_run.read_outcomes_of_other_version())
    print(f"\nOther version\n{format_plain_table(figures)}", file=output)
    for answers in comparisons:
        if answers.differs:
            print(format_difference(answers), file=output)
    print(format_summary(comparisons), file=output)


def _check_seed(options: Namespace) -> None:
    """Refuse to report results with development seeds, and to calibrate with report seeds."""
    if options.source is not None:
        return
    if options.report is not None and options.seed < MIN_REPORTED_SEED:
        raise InputError(
            f"--report with --seed {options.seed}: seeds below {MIN_REPORTED_SEED} are for "
            f"development; use a seed from {MIN_REPORTED_SEED} on"
        )
    if options.calibrate is not None and options.seed >= MIN_REPORTED_SEED:
        raise InputError(f"--calibrate with --seed {options.seed}: {_SEED_RULE}; {_SEED_ADVICE}")


def _read_additional_runs(options: Namespace) -> FinishedRuns:
    if options.beside and options.calibrate is None:
        raise InputError("--beside goes with --calibrate; give both, or leave it out")
    runs = [read_finished_run(folder) for folder in options.beside]
    for folder, (key, _) in zip(options.beside, runs, strict=True):
        seed = key.get("seed", 0)
        if not isinstance(seed, int) or seed >= MIN_REPORTED_SEED:
            raise InputError(f"--beside {folder}: its seed is {seed}; {_SEED_RULE}; {_SEED_ADVICE}")
    return runs


def _make_naive_methods(options: Namespace, folder: Path) -> AskNaiveMethods:
    robot = load_robot(options.robot)
    check_robot(robot, options.robot)
    return partial(
        answer_case, classifier=load_or_train_classifier(robot, folder / "classifier.npz")
    )


def _make_case_source(options: Namespace) -> tuple[CaseSource, Path]:
    if (options.source is None) != (options.labels is None):
        raise InputError("--from DIR and --labels FILE belong together; give both or neither")
    if options.source is not None:
        if options.cases is not None:
            raise InputError(
                "--cases: with --from, all cases of the folder are scored; leave it out"
            )
        robot = _resolve_robot(options)
        name = f"rotemina-blind-{options.source.resolve().name}"
        return FolderCaseSource(options.source, options.labels, robot), options.folder or Path(name)
    number = _DEFAULT_CASE_COUNT if options.cases is None else options.cases
    if number < 1 or options.seed < 0:
        raise InputError(
            f"--cases {number} --seed {options.seed}: at least 1 case, no seed below 0"
        )
    # The equations of the second generator differ from those of the first.
    uses_second_generator = options.generator == "second"
    name = f"rotemina-blind-{options.seed}{'-second' if uses_second_generator else ''}"
    cases = GeneratedCaseSource(
        _resolve_robot(options), number, options.seed, second=uses_second_generator
    )
    return cases, options.folder or Path(name)


def _resolve_robot(options: Namespace) -> str:
    """Return the value of ``--robot``, as an absolute path if it is a file."""
    name = str(options.robot)
    return str(Path(name).resolve()) if Path(name).is_file() else name


def _write_results(
    options: Namespace,
    cases: CaseSource,
    outcomes: list[CaseOutcome],
    naive_outcomes: dict[str, list[CaseOutcome]],
    additional_runs: FinishedRuns,
) -> None:
    figures = score(outcomes)
    naive_figures = {
        title: _keep_cause_figures(score(answered)) for title, answered in naive_outcomes.items()
    }
    counts = count_confusion(outcomes)
    group_figures = {
        name: score(group) for name, group in split_by_remainder(outcomes).items() if group
    }
    text = format_json(_make_document(cases, outcomes, figures, naive_figures, group_figures))
    # All files are replaced together, or none.
    with ExitStack() as files:
        if options.report is not None:
            picture = options.report.with_suffix(".svg")
            files.enter_context(replace_file(options.report)).write(
                format_page(
                    figures,
                    outcomes,
                    picture.name,
                    _describe_cases(cases, len(outcomes)),
                    {
                        **{
                            REMAINDER_GROUP_TITLES[name]: figures_of_group
                            for name, figures_of_group in group_figures.items()
                        },
                        **naive_figures,
                    },
                ).encode("utf-8")
            )
            draw_confusion(counts, files.enter_context(replace_file(picture)))
        if options.calibrate is not None:
            calibration = format_json(_make_calibration_document(cases, outcomes, additional_runs))
            files.enter_context(replace_file(options.calibrate)).write(calibration.encode("utf-8"))
        if options.json not in (None, "-"):
            files.enter_context(replace_file(options.json)).write(text.encode("utf-8"))
    if options.json == "-":
        print(text)
        return
    print(format_plain_table(figures))
    for name, figures_of_group in group_figures.items():
        print(f"\n{REMAINDER_GROUP_TITLES[name]}\n{format_plain_table(figures_of_group)}")


def _make_calibration_document(
    cases: CaseSource, outcomes: Sequence[CaseOutcome], additional_runs: FinishedRuns
) -> dict[str, Any]:
    all_outcomes = [
        *outcomes,
        *(outcome for _, run_outcomes in additional_runs for outcome in run_outcomes),
    ]
    return {
        "format": CALIBRATION_FORMAT,
        "cases": [dict(cases.key), *(key for key, _ in additional_runs)],
        "done": len(all_outcomes),
        **fit_calibration(all_outcomes).as_json(),
    }


def _make_document(
    cases: CaseSource,
    outcomes: list[CaseOutcome],
    figures: dict[str, IntervalEstimate],
    naive_figures: dict[str, dict[str, IntervalEstimate]],
    group_figures: dict[str, dict[str, IntervalEstimate]],
) -> dict[str, Any]:
    return {
        "format": FIGURES_FORMAT,
        "cases": dict(cases.key),
        "asked": len(cases.names),
        "done": len(outcomes),
        "figures": _figures_to_json(figures),
        "halves": {name: _figures_to_json(group) for name, group in group_figures.items()},
        "naive": {title: _figures_to_json(naive) for title, naive in naive_figures.items()},
        "confusion": [
            {"truth": truth, "named": diagnosed, "number": number}
            for (truth, diagnosed), number in sorted(count_confusion(outcomes).items())
        ],
        "wrong": [
            {"case": o.name, "label": dict(o.label), "answer": dict(o.answer)}
            for o in outcomes
            if not o.is_correct
        ],
    }


def _describe_cases(cases: CaseSource, finished_count: int) -> str:
    description = ", ".join(f"{key} `{value}`" for key, value in cases.key.items())
    total = len(cases.names)
    count = f"{total}" if finished_count == total else f"{finished_count} of {total}"
    return f"{count} cases of {description}"


def _keep_cause_figures(figures: dict[str, IntervalEstimate]) -> dict[str, IntervalEstimate]:
    """Keep the figures about causes.

    Naive methods predict no records, so there is no closure of the gap, and they are not timed.
    """
    return {
        key: figure for key, figure in figures.items() if not key.startswith(("closure", "seconds"))
    }


def _figures_to_json(figures: dict[str, IntervalEstimate]) -> dict[str, Any]:
    return {key: figure.as_json() for key, figure in figures.items()}
