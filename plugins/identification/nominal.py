"""What the nominal model answers to the same inputs, to be looked at in the same way."""

from rotemina.plugins.identification.question import Question
from rotemina.sim.identification.signals import Signals, siso
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Tap


def nominal_signals(question: Question) -> Signals:
    """Simulate the nominal model and return its input and output of the pair asked for.

    The model is driven by the record's commands, or by its measured ``u`` where that is the
    input. Hold, delay, loops and the length of the record then act on both alike, so what differs
    in the drawing differs in the machine.

    Raises
    ------
    InputError
        If the record does not fit the robot, or holds nothing to drive the model by.
    """
    measured = question.signals()
    by = Tap.U if question.drive is Tap.U else Tap.CMD
    response = nominal_response(question.robot, question.record, drive=by)
    if question.drive is Tap.REF:
        driven = response.signal(question.axis, Tap.REF)
    else:
        driven = question.record.signal(question.axis, question.drive)
    answer = response.signal(question.axis, question.answer)
    return siso(driven, answer, measured.rate_hz, measured.period_samples)
