"""Suggested experiments as records: a trajectory that a robot plays, and what rivals predict."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rotemina.sim.gap.diagnosis import Experiment
from rotemina.sim.gap.output.document import ExperimentFiles
from rotemina.sim.records.record import Record, Tap

_NOT_IN_NAMES = re.compile(r"[^A-Za-z0-9_.-]")


@dataclass(frozen=True, slots=True)
class Suggestion:
    """The files of one experiment: their names and records."""

    names: ExperimentFiles
    records: Mapping[str, Record]


def suggestion(
    experiment: Experiment, number: int, stem: str, units: Mapping[str, str]
) -> Suggestion:
    """Return the files of an experiment, the ``number``-th of a document named ``stem``.

    Parameters
    ----------
    experiment : Experiment
    number : int
        From 1.
    stem : str
        With what the names of the files begin.
    units : mapping axis -> "m" or "rad"
    """
    time_s = np.array(experiment.time_s, dtype=np.float64)
    commands = {
        (axis, Tap.CMD): np.array(values, dtype=np.float64)
        for axis, values in experiment.commands.items()
    }
    said = {
        "excitation": "suggested by a gap diagnosis",
        "splits": f"{', '.join(experiment.splits) or 'effects'} on {experiment.axis}",
    }
    name = f"{stem}_experiment_{number}"
    records = {f"{name}.csv": Record.from_signals(time_s, commands, units, said)}
    predictions = {}
    for rival, reading in experiment.predictions.items():
        predictions[rival] = f"{name}_if_{_NOT_IN_NAMES.sub('_', rival)}.csv"
        signals = {
            **commands,
            (experiment.axis, experiment.tap): np.array(reading, dtype=np.float64),
        }
        own = {**said, "predicted by": f"the model with {rival} on {experiment.axis}"}
        records[predictions[rival]] = Record.from_signals(time_s, signals, units, own)
    return Suggestion(ExperimentFiles(f"{name}.csv", predictions), records)


def may_be_suggested(name: str, stem: str) -> bool:
    """Whether a file name may be that of a suggestion of a document named ``stem``."""
    return re.fullmatch(rf"{re.escape(stem)}_experiment_\d+(_if_.*)?\.csv", name) is not None
