"""Suggested experiments as records: a trajectory to play, and the prediction of each rival."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rotemina.sim.gap.output import ExperimentFiles
from rotemina.sim.gap.result import SuggestedExperiment
from rotemina.sim.records import Record, Tap

_UNSAFE_CHARACTERS = re.compile(r"[^A-Za-z0-9_.-]")


@dataclass(frozen=True, slots=True)
class ExperimentRecords:
    """The files of one suggested experiment: their names and records."""

    names: ExperimentFiles
    records: Mapping[str, Record]


def make_experiment_records(
    experiment: SuggestedExperiment, number: int, stem: str, units: Mapping[str, str]
) -> ExperimentRecords:
    """Return the files of an experiment, the ``number``-th of a document named ``stem``.

    Parameters
    ----------
    experiment : SuggestedExperiment
    number : int
        Number of the experiment, from 1.
    stem : str
        Stem of the document, with which the file names begin.
    units : mapping axis -> "m" or "rad"
    """
    time_s = np.array(experiment.time_s, dtype=np.float64)
    commands = {
        (axis, Tap.CMD): np.array(values, dtype=np.float64)
        for axis, values in experiment.commands.items()
    }
    metadata = {
        "excitation": "suggested by a gap diagnosis",
        "splits": f"{', '.join(experiment.splits) or 'effects'} on {experiment.axis}",
    }
    name = f"{stem}_experiment_{number}"
    records = {f"{name}.csv": Record.from_signals(time_s, commands, units, metadata)}
    predictions = {}
    for rival, reading in experiment.predictions.items():
        predictions[rival] = f"{name}_if_{_UNSAFE_CHARACTERS.sub('_', rival)}.csv"
        signals = {
            **commands,
            (experiment.axis, experiment.tap): np.array(reading, dtype=np.float64),
        }
        rival_metadata = {
            **metadata,
            "predicted by": f"the model with {rival} on {experiment.axis}",
        }
        records[predictions[rival]] = Record.from_signals(time_s, signals, units, rival_metadata)
    return ExperimentRecords(ExperimentFiles(f"{name}.csv", predictions), records)


def is_experiment_file(name: str, stem: str) -> bool:
    """Return whether a file name belongs to a suggested experiment of a document named ``stem``."""
    return re.fullmatch(rf"{re.escape(stem)}_experiment_\d+(_if_.*)?\.csv", name) is not None
