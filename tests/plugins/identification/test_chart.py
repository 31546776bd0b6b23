"""The tick labels of logarithmic axes, and the curves drawn on them."""

import numpy as np
import pytest

from rotemina.app.widgets.style.theme import DARK
from rotemina.plugins.identification.chart import PictureChart, compute_log_ticks
from rotemina.plugins.identification.findings import AnalysisCurve, AnalysisPicture


@pytest.mark.parametrize(
    ("low", "high", "size", "expected"),
    [
        (-0.35, 0.36, 100, [0.5, 1.0, 2.0]),
        (0.0, 3.0, 200, [1.0, 10.0, 100.0, 1000.0]),
        (-6.0, 2.0, 100, [1e-6, 1e-3, 1.0]),
    ],
)
def test_tick_labels_are_placed_where_there_is_room(low, high, size, expected):
    (_, label_positions), (_, line_positions) = compute_log_ticks(low, high, size, [])
    np.testing.assert_allclose(10.0 ** np.array(label_positions), expected)
    assert all(low < position < high for position in line_positions)


def test_curves_are_drawn_on_logarithmic_axes_and_replaced(qtbot):
    chart = PictureChart(DARK)
    qtbot.addWidget(chart)
    x = np.array([1.0, 10.0, 100.0])
    curve = AnalysisCurve("measured", "real", x, np.array([1.0, 0.0, 0.01]))
    other = AnalysisCurve("model", "model", x, x)
    chart.show_picture(AnalysisPicture("gain", "frequency [Hz]", (curve, other), True, True))
    np.testing.assert_allclose(chart.plot.read_points(0), [[0.0, 1.0, 2.0], [0.0, -2.0, -2.0]])
    assert "model" in chart.title.text()
    chart.show_picture(AnalysisPicture("course", "time [s]", (curve,)))
    np.testing.assert_allclose(chart.plot.read_points(0), [curve.x, curve.y])
    assert chart.title.text() == "course"


def test_a_flat_response_keeps_a_readable_scale(qtbot):
    chart = PictureChart(DARK)
    qtbot.addWidget(chart)
    x = np.array([1.0, 10.0])
    chart.show_picture(
        AnalysisPicture("gain", "f", (AnalysisCurve("", "real", x, np.ones(2)),), True, True)
    )
    low, high = chart.plot.viewRange()[1]
    assert high - low == pytest.approx(1.0)
