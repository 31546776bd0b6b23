"""Response of the nominal model to the input of a record, for the same analysis as the record."""

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.record_query import AnalysisQuestion
from rotemina.sim.identification import ExperimentSignals, make_siso_signals
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap

NO_NOMINAL_MODEL = mark("The nominal model is not shown: {reason}")


def simulate_nominal_signals(question: AnalysisQuestion) -> ExperimentSignals:
    """Simulate the nominal model, and return its input and output for the pair of taps.

    The model is driven by the commands of the record, or by the measured ``u`` if that is the
    input. The hold of the commands, delays, feedback loops and the length of the record then affect
    the model and the machine alike. So a difference in the picture is a difference between model
    and machine.

    Raises
    ------
    InputError
        If the record does not fit the robot, or has no signal to drive the model with.
    KeyError
        If the model has no such tap.
    """
    measured = question.signals()
    record = simulate_nominal_record(question)
    input_signal, output_signal = (
        record.signal(question.axis, tap) for tap in (question.input_tap, question.output_tap)
    )
    return make_siso_signals(input_signal, output_signal, measured.rate_hz, measured.period_samples)


def simulate_nominal_record(question: AnalysisQuestion) -> Record:
    """Simulate the nominal model, and return a record of the pair of taps.

    The samples need not be equally spaced.

    Raises
    ------
    InputError, KeyError
        The same as in :func:`simulate_nominal_signals`.
    """
    record, axis = question.record, question.axis
    driving_tap = Tap.U if question.input_tap is Tap.U else Tap.CMD
    response = simulate_nominal_response(question.robot, record, drive=driving_tap)
    # The model has its own true position; commands and voltages are those of the record.
    if question.input_tap is Tap.REF:
        input_signal = response.signal(axis, Tap.REF)
    else:
        input_signal = record.signal(axis, question.input_tap)
    signals = {
        (axis, question.input_tap): input_signal,
        (axis, question.output_tap): response.signal(axis, question.output_tap),
    }
    units = {axis: record.units[axis]}
    return Record.from_signals(record.time_s, signals, units, record.metadata)
