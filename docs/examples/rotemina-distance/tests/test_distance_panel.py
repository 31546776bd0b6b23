"""The panel can be shown in every theme and shows the distances of the axes from its zero."""

from rotemina.app.plugin_kit import check_panel, open_panel_bench

from rotemina_distance.panel import DistancePanel


def test_it_can_be_made_shown_and_closed():
    results = check_panel(DistancePanel)
    assert [result for result in results if result.verdict == "failed"] == []


def test_it_shows_the_positions_until_a_zero_is_set():
    with open_panel_bench(DistancePanel) as bench:
        bench.refresh()
        assert bench.panel.readouts["x"].text() == bench.text_of("x")
        assert bench.panel.age.text() == "fresh"
        bench.advance(3.0, read=False)
        assert bench.panel.age.text() == "3.0 s"


def test_it_shows_the_distance_of_an_axis_from_the_zero():
    with open_panel_bench(DistancePanel) as bench:
        bench.refresh()
        bench.panel.zero_here.click()
        bench.workbench.session.jog("x", 1e-3)
        bench.advance(5.0)
        number, unit = bench.panel.readouts["x"].text().split()
        assert abs(float(number) - 1.0) < 0.01
        assert unit == "mm"


def test_without_a_reading_it_says_so():
    with open_panel_bench(DistancePanel) as bench:
        notices = []
        bench.workbench.notice_posted.connect(lambda level, text: notices.append(text))
        bench.panel.zero_here.click()
        assert notices == ["Distance: no position has been read yet. Connect the machine first."]
