"""The views of a pair of taps, in the order of the panel."""

from collections.abc import Callable
from enum import StrEnum

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.findings import Findings
from rotemina.plugins.identification.frequency import frequency_findings
from rotemina.plugins.identification.health_card import health_findings
from rotemina.plugins.identification.hysteresis_loop import loop_findings
from rotemina.plugins.identification.low_order_fit import model_findings
from rotemina.plugins.identification.record_query import Question
from rotemina.plugins.identification.staircase import step_findings


class View(StrEnum):
    """A view, as named in files."""

    FREQUENCY = mark("Frequency response")
    LOOP = mark("Loop")
    STEPS = mark("Steps")
    MODEL = mark("Fitted model")
    HEALTH = mark("Health card")


LOOKS: dict[View, Callable[[Question], Findings]] = {
    View.FREQUENCY: frequency_findings,
    View.LOOP: loop_findings,
    View.STEPS: step_findings,
    View.MODEL: model_findings,
    View.HEALTH: health_findings,
}
