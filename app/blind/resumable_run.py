"""The sealed self-test with one result file per case, so that it can be resumed."""

import secrets
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from rotemina.app.bench import EngineAnswers, describe_answer
from rotemina.app.blind.cases import CaseSource, SealedCase
from rotemina.app.blind.closure import HeldOutGap, compute_closure, compute_held_out_gaps
from rotemina.app.blind.diagnosis_process import BlindAnswer
from rotemina.app.errors import BlindError
from rotemina.app.settings import format_json, write_text
from rotemina.sim.blind import CaseOutcome, LabelSeal
from rotemina.sim.files import parse_json, read_text
from rotemina.sim.robot_files import load_robot

_MAX_FILE_BYTES = 64_000_000
RESULT_FORMAT = "rotemina-blind-result 1"
_SCORED_CAUSE_KEYS = (
    "axis",
    "effect",
    "from_axis",
    "probability",
    "weight",
    "ambiguous_with",
    "closed",
)
AskDiagnosis = Callable[[SealedCase], BlindAnswer]
AskNaiveMethods = Callable[[SealedCase], Mapping[str, Any]]


@dataclass(frozen=True, slots=True)
class CaseShard:
    """Every ``count``-th case, beginning with case number ``index`` (from 1)."""

    index: int = 1
    count: int = 1

    def select_cases(self, names: Sequence[str]) -> list[str]:
        """Return the names of this shard's cases."""
        return list(names[self.index - 1 :: self.count])


class ResumableBlindRun:
    """A run whose results are in a folder; cases with a result are not repeated.

    Raises
    ------
    BlindError
        If the folder holds the results of other cases, or cannot be created.
    """

    def __init__(self, folder: Path, cases: CaseSource) -> None:
        self._folder, self._cases = folder, cases
        try:
            (folder / "results").mkdir(parents=True, exist_ok=True)
            (folder / "commitments").mkdir(exist_ok=True)
        except OSError as error:
            raise BlindError(
                f"{folder}: the folder cannot be created ({error.strerror})"
            ) from error
        key_path = folder / "cases.json"
        if key_path.exists() and (other_key := _read_json(key_path)) != dict(cases.key):
            raise BlindError(
                f"{folder}: holds the results of other cases ({other_key}); name another folder"
            )
        write_text(key_path, format_json(dict(cases.key)))

    def list_pending(self, shard: CaseShard) -> list[str]:
        """Return the names of the cases of a shard that have no result yet."""
        return [
            name
            for name in shard.select_cases(self._cases.names)
            if not self._make_result_path(name).exists()
        ]

    def run_case(
        self,
        name: str,
        diagnose: AskDiagnosis,
        ask_naive_methods: AskNaiveMethods | None = None,
        diagnose_otherwise: AskDiagnosis | None = None,
    ) -> None:
        """Seal the label of a case, run the diagnosis, hash its answer, then open the label.

        Labels that share a file stay sealed until :meth:`open_labels`. ``ask_naive_methods``
        returns the answers of the naive methods to the case, by their names.
        ``diagnose_otherwise`` is another version of the diagnosis, for comparison.
        """
        salt = secrets.token_hex(16)
        with self._cases.open_case(name, salt) as case:
            commitment = {"case": name, "sha256": case.seal.digest}
            write_text(self._folder / "commitments" / f"{name}.json", format_json(commitment))
            answer = diagnose(case)
            entry = _make_answer_entry(case, answer)
            other = None if diagnose_otherwise is None else diagnose_otherwise(case)
            against = None if other is None else _make_answer_entry(case, other)
            others = {} if ask_naive_methods is None else ask_naive_methods(case)
        result = {
            "format": RESULT_FORMAT,
            "case": name,
            "commitment": case.seal.digest,
            "salt": salt,
            "answer_sha256": answer.sha256,
            **entry,
            "others": dict(others),
        }
        if against is not None:
            result["against"] = against
        if not self._cases.has_one_label_file:
            result["label"] = dict(self._cases.open_label(name, salt, case.seal))
        write_text(self._make_result_path(name), format_json(result))

    def open_labels(self) -> None:
        """Open the labels that are still sealed, and write them into the results."""
        for path, result in self._read_results():
            if "label" not in result:
                seal = LabelSeal(result["commitment"])
                label = self._cases.open_label(result["case"], result["salt"], seal)
                write_text(path, format_json({**result, "label": dict(label)}))

    def read_outcomes(self) -> list[CaseOutcome]:
        """Return the outcomes of all results with an open label, of any shard."""
        return [_make_outcome(result) for _, result in self._read_results() if "label" in result]

    def read_outcomes_of(self, method: str) -> list[CaseOutcome]:
        """Return the outcomes of another method, for the cases that the method has answered."""
        return [
            replace(_make_outcome(result), answer=result["others"][method], closure=None)
            for _, result in self._read_results()
            if "label" in result and method in result["others"]
        ]

    def read_outcomes_of_other_version(self) -> list[CaseOutcome]:
        """Return the outcomes of the other version, for the cases that it has answered."""
        return [
            _make_outcome({**result, **result["against"]})
            for _, result in self._read_results()
            if "label" in result and "against" in result
        ]

    def compare_versions(self) -> list[EngineAnswers]:
        """Return the answers of both versions to the cases that both have answered."""
        return [
            EngineAnswers(
                result["case"],
                describe_answer(result["answer"]),
                describe_answer(result["against"]["answer"]),
                result["processor_s"],
                result["against"]["processor_s"],
                _describe_label(result["label"]),
            )
            for _, result in self._read_results()
            if "label" in result and "against" in result
        ]

    def _read_results(self) -> Iterator[tuple[Path, dict[str, Any]]]:
        return _read_results_in(self._folder)

    def _make_result_path(self, name: str) -> Path:
        return self._folder / "results" / f"{name}.json"


def read_finished_run(folder: Path) -> tuple[dict[str, Any], list[CaseOutcome]]:
    """Return the key that identifies a folder's cases, and the outcomes of the finished ones.

    Raises
    ------
    BlindError
        If the folder holds no blind test.
    """
    if not (folder / "cases.json").is_file():
        raise BlindError(f"{folder}: holds no results of a blind test; name a folder that does")
    key = _read_json(folder / "cases.json")
    return key, [
        _make_outcome(result) for _, result in _read_results_in(folder) if "label" in result
    ]


def _read_results_in(folder: Path) -> Iterator[tuple[Path, dict[str, Any]]]:
    for path in sorted((folder / "results").glob("*.json")):
        result = _read_json(path)
        if result.get("format") != RESULT_FORMAT:
            raise BlindError(f"{path}: not a result of a blind test; remove it")
        yield path, result


def _read_json(path: Path) -> dict[str, Any]:
    text = read_text(path, BlindError, _MAX_FILE_BYTES, advice="remove it")
    content = parse_json(text, str(path), BlindError)
    return content if isinstance(content, dict) else {}


def _compute_gaps(case: SealedCase, answer: BlindAnswer) -> dict[str, HeldOutGap]:
    if case.measured is None or answer.predicted is None:
        return {}
    return compute_held_out_gaps(load_robot(case.robot), case.measured, answer.predicted)


def _make_answer_entry(case: SealedCase, answer: BlindAnswer) -> dict[str, Any]:
    gaps = _compute_gaps(case, answer)
    return {
        "answer": _keep_scored_keys(answer.document),
        "seconds": round(answer.seconds, 3),
        "processor_s": round(answer.processor_s, 3),
        "held_out": {axis: list(gap) for axis, gap in gaps.items()},
    }


def _describe_label(label: Mapping[str, Any]) -> str:
    effects = [f"{effect['effect']} on {effect['axis']}" for effect in label["effects"]]
    return ", ".join(effects) or str(label["verdict"])


def _keep_scored_keys(document: Mapping[str, Any]) -> dict[str, Any]:
    causes = [
        {key: cause[key] for key in _SCORED_CAUSE_KEYS if key in cause}
        for cause in document.get("causes", [])
    ]
    document_keys = ("verdict", "axes", "why", "suspected")
    return {**{key: document[key] for key in document_keys if key in document}, "causes": causes}


def _make_outcome(result: Mapping[str, Any]) -> CaseOutcome:
    label = result["label"]
    truth: dict[str, list[str]] = {}
    for effect in label["effects"]:
        truth.setdefault(effect["axis"], []).append(effect["effect"])
    gaps = {axis: HeldOutGap(*values) for axis, values in result["held_out"].items()}
    closure = compute_closure(gaps, truth) if label["verdict"] == "explained" else None
    return CaseOutcome(result["case"], label, result["answer"], result["seconds"], closure)
