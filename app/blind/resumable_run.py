"""The sealed self-test, case by case, with one result file each, so that it can be resumed."""

import secrets
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from rotemina.app.blind.cases import BlindError, Cases, SealedCase
from rotemina.app.blind.closure import Gap, closure, held_out_gaps
from rotemina.app.blind.diagnosis_process import Answer
from rotemina.app.blind.shard import Shard
from rotemina.app.files import json_text, write_text
from rotemina.sim.blind.scoring import Outcome
from rotemina.sim.blind.sealing import Seal
from rotemina.sim.input_files import parse_json, read_text
from rotemina.sim.robot.file import load_robot

_MOST_BYTES = 64_000_000
FORMAT = "rotemina-blind-result 1"
_KEPT = ("axis", "effect", "from_axis", "probability", "weight", "ambiguous_with", "closed")

Ask = Callable[[SealedCase], Answer]
Contest = Callable[[SealedCase], Mapping[str, Any]]


class BlindRun:
    """A folder of results; finished cases are not repeated.

    Raises
    ------
    BlindError
        If the folder holds the results of other cases, or cannot be made.
    """

    def __init__(self, folder: Path, cases: Cases) -> None:
        self._folder, self._cases = folder, cases
        try:
            (folder / "results").mkdir(parents=True, exist_ok=True)
            (folder / "commitments").mkdir(exist_ok=True)
        except OSError as error:
            raise BlindError(f"{folder}: it cannot be made ({error.strerror})") from error
        key = folder / "cases.json"
        if key.exists() and (found := _read(key)) != dict(cases.key):
            raise BlindError(
                f"{folder}: it holds the results of other cases ({found}); name another folder"
            )
        write_text(key, json_text(dict(cases.key)))

    def pending(self, shard: Shard) -> list[str]:
        """Return the cases of a shard that have no result yet."""
        return [name for name in shard.of(self._cases.names) if not self._result(name).exists()]

    def do(self, name: str, ask: Ask, contest: Contest | None = None) -> None:
        """Seal a case's label, ask the diagnosis, hash its answer, then open the label.

        Labels that share a file stay closed until :meth:`open_labels`. ``contest``: what others
        than the diagnosis say of the case, by their names.
        """
        salt = secrets.token_hex(16)
        with self._cases.sealed(name, salt) as case:
            commitment = {"case": name, "sha256": case.seal.digest}
            write_text(self._folder / "commitments" / f"{name}.json", json_text(commitment))
            answer = ask(case)
            gaps = _gaps(case, answer)
            others = {} if contest is None else contest(case)
        result = {
            "format": FORMAT,
            "case": name,
            "commitment": case.seal.digest,
            "salt": salt,
            "answer_sha256": answer.sha256,
            "answer": _compact(answer.document),
            "seconds": round(answer.seconds, 3),
            "others": dict(others),
            "held_out": {axis: list(gap) for axis, gap in gaps.items()},
        }
        if not self._cases.one_file:
            result["label"] = dict(self._cases.label(name, salt, case.seal))
        write_text(self._result(name), json_text(result))

    def open_labels(self) -> None:
        """Open the labels that are still closed, and write them to their results."""
        for path, result in self._results():
            if "label" not in result:
                sealed = Seal(result["commitment"])
                label = self._cases.label(result["case"], result["salt"], sealed)
                write_text(path, json_text({**result, "label": dict(label)}))

    def outcomes(self) -> list[Outcome]:
        """Return all that is done and opened, whichever shard did it."""
        return [_outcome(result) for _, result in self._results() if "label" in result]

    def outcomes_of(self, other: str) -> list[Outcome]:
        """Return the outcomes of another contestant, for the cases that it was asked."""
        return [
            replace(_outcome(result), answer=result["others"][other], closure=None)
            for _, result in self._results()
            if "label" in result and other in result["others"]
        ]

    def _results(self) -> Iterator[tuple[Path, dict[str, Any]]]:
        return _results_in(self._folder)

    def _result(self, name: str) -> Path:
        return self._folder / "results" / f"{name}.json"


def finished(folder: Path) -> tuple[dict[str, Any], list[Outcome]]:
    """Return what tells the cases of a folder from others, and the outcomes of those done.

    Raises
    ------
    BlindError
        If it is no folder of a blind test.
    """
    if not (folder / "cases.json").is_file():
        raise BlindError(f"{folder}: it holds no results of a blind test; name one that does")
    key = _read(folder / "cases.json")
    return key, [_outcome(result) for _, result in _results_in(folder) if "label" in result]


def _results_in(folder: Path) -> Iterator[tuple[Path, dict[str, Any]]]:
    for path in sorted((folder / "results").glob("*.json")):
        result = _read(path)
        if result.get("format") != FORMAT:
            raise BlindError(f"{path}: it is no result of a blind test; remove it")
        yield path, result


def _read(path: Path) -> dict[str, Any]:
    text = read_text(path, BlindError, _MOST_BYTES, advice="remove it")
    read = parse_json(text, str(path), BlindError)
    return read if isinstance(read, dict) else {}


def _gaps(case: SealedCase, answer: Answer) -> dict[str, Gap]:
    if case.measured is None or answer.predicted is None:
        return {}
    return held_out_gaps(load_robot(case.robot), case.measured, answer.predicted)


def _compact(document: Mapping[str, Any]) -> dict[str, Any]:
    """Keep what is scored."""
    causes = [
        {key: cause[key] for key in _KEPT if key in cause} for cause in document.get("causes", [])
    ]
    kept = ("verdict", "axes", "why", "suspected")
    return {**{key: document[key] for key in kept if key in document}, "causes": causes}


def _outcome(result: Mapping[str, Any]) -> Outcome:
    label = result["label"]
    truth: dict[str, list[str]] = {}
    for effect in label["effects"]:
        truth.setdefault(effect["axis"], []).append(effect["effect"])
    gaps = {axis: Gap(*numbers) for axis, numbers in result["held_out"].items()}
    closed = closure(gaps, truth) if label["verdict"] == "explained" else None
    return Outcome(result["case"], label, result["answer"], result["seconds"], closed)
