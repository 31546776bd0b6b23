"""The panel can be shown in every theme, and tells how far the axes are from its zero."""

from rotemina.app.plugin_kit.panel_bench import panel_bench
from rotemina.app.plugin_kit.panel_check import check_panel

from rotemina_distance.panel import DistancePanel


def test_it_can_be_made_shown_and_closed():
    results = check_panel(DistancePanel)
    assert [result for result in results if result.verdict == "failed"] == []


def test_it_tells_where_the_axes_are_until_a_zero_is_set():
    with panel_bench(DistancePanel) as bench:
        bench.refresh()
        assert bench.panel.readouts["x"].text() == bench.text_of("x")
        assert bench.panel.age.text() == "fresh"
        bench.advance(3.0, read=False)
        assert bench.panel.age.text() == "3.0 s"


def test_it_tells_how_far_an_axis_has_gone_from_the_zero():
    with panel_bench(DistancePanel) as bench:
        bench.refresh()
        bench.panel.zero_here.click()
        bench.workbench.session.jog("x", 1e-3)
        bench.advance(5.0)
        number, unit = bench.panel.readouts["x"].text().split()
        assert abs(float(number) - 1.0) < 0.01
        assert unit == "mm"


def test_without_a_reading_it_says_so():
    with panel_bench(DistancePanel) as bench:
        told = []
        bench.workbench.noticed.connect(lambda level, text: told.append(text))
        bench.panel.zero_here.click()
        assert told == ["Distance: there is no reading yet to start from"]
