"""The nominal model's answer to the same inputs, for the same analysis."""

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.record_query import Question
from rotemina.sim.identification.experiment_signals import Signals, siso
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap

ABSENT = mark("The nominal model is not shown: {reason}")


def nominal_signals(question: Question) -> Signals:
    """Simulate the nominal model and return its input and output of the pair asked for.

    The model is driven by the record's commands, or by its measured ``u`` where that is the
    input. Hold, delay, loops and the length of the record then act on both alike, so what differs
    in the drawing differs in the machine.

    Raises
    ------
    InputError
        If the record does not fit the robot, or holds nothing to drive the model by.
    KeyError
        If the model has no such tap.
    """
    measured = question.signals()
    record = nominal_record(question)
    driven, answer = (record.signal(question.axis, t) for t in (question.drive, question.answer))
    return siso(driven, answer, measured.rate_hz, measured.period_samples)


def nominal_record(question: Question) -> Record:
    """Return a record of the pair alone, as the model makes it; rows need not be equally spaced.

    Raises
    ------
    InputError, KeyError
        As :func:`nominal_signals`.
    """
    record, axis = question.record, question.axis
    by = Tap.U if question.drive is Tap.U else Tap.CMD
    response = nominal_response(question.robot, record, drive=by)
    if question.drive is Tap.REF:
        driven = response.signal(axis, Tap.REF)
    else:
        driven = record.signal(axis, question.drive)
    signals = {
        (axis, question.drive): driven,
        (axis, question.answer): response.signal(axis, question.answer),
    }
    units = {axis: record.units[axis]}
    return Record.from_signals(record.time_s, signals, units, record.metadata)
