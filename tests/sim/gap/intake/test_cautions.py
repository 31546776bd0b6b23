"""Cautions as remarks."""

from rotemina.sim.gap.intake.cautions import Caution, remarks
from rotemina.sim.messages import message


def test_remarks_know_no_order_of_records():
    a, b, c = (message("gap", text) for text in ("A.", "B.", "C."))
    cautions = [Caution(b, "x", 1), Caution(a, None, 0), Caution(b, "x", 0), Caution(c, "y")]
    assert remarks(cautions, "x") == remarks(cautions[::-1], "x") == (a, b)
