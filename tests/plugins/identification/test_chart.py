"""The numbers of logarithmic axes, and what is drawn on them."""

import numpy as np
import pytest

from rotemina.app.shell.theme import DARK
from rotemina.plugins.identification.chart import Chart, log_ticks
from rotemina.plugins.identification.findings import Curve, Picture


@pytest.mark.parametrize(
    ("low", "high", "size", "expected"),
    [
        (-0.35, 0.36, 100, [0.5, 1.0, 2.0]),
        (0.0, 3.0, 200, [1.0, 10.0, 100.0, 1000.0]),
        (-6.0, 2.0, 100, [1e-6, 1e-3, 1.0]),
    ],
)
def test_numbers_stand_where_there_is_room(low, high, size, expected):
    (_, numbers), (_, lines) = log_ticks(low, high, size, [])
    np.testing.assert_allclose(10.0 ** np.array(numbers), expected)
    assert all(low < line < high for line in lines)


def test_curves_are_drawn_as_logarithms_and_replaced(qtbot):
    chart = Chart(DARK)
    qtbot.addWidget(chart)
    x = np.array([1.0, 10.0, 100.0])
    curve = Curve("measured", "real", x, np.array([1.0, 0.0, 0.01]))
    other = Curve("model", "model", x, x)
    chart.show_picture(Picture("gain", "frequency [Hz]", (curve, other), True, True))
    np.testing.assert_allclose(chart.plot.values(0), [[0.0, 1.0, 2.0], [0.0, -2.0, -2.0]])
    assert "model" in chart.title.text()
    chart.show_picture(Picture("course", "time [s]", (curve,)))
    np.testing.assert_allclose(chart.plot.values(0), [curve.x, curve.y])
    assert chart.title.text() == "course"


def test_a_flat_response_keeps_a_scale_that_can_be_read(qtbot):
    chart = Chart(DARK)
    qtbot.addWidget(chart)
    x = np.array([1.0, 10.0])
    chart.show_picture(Picture("gain", "f", (Curve("", "real", x, np.ones(2)),), True, True))
    low, high = chart.plot.viewRange()[1]
    assert high - low == pytest.approx(1.0)
