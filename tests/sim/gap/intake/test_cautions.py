"""Cautions that become remarks."""

from rotemina.sim.gap.intake import RecordCaution, collect_remarks
from rotemina.sim.messages import message


def test_remarks_do_not_depend_on_the_order_of_records():
    a, b, c = (message("gap", text) for text in ("A.", "B.", "C."))
    cautions = [
        RecordCaution(b, "x", 1),
        RecordCaution(a, None, 0),
        RecordCaution(b, "x", 0),
        RecordCaution(c, "y"),
    ]
    assert collect_remarks(cautions, "x") == collect_remarks(cautions[::-1], "x") == (a, b)
