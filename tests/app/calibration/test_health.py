"""Health cards: figures of an axis from a record, stored and compared with the last card."""

from datetime import UTC, datetime

import numpy as np
import pytest

from rotemina.app.calibration import HealthBook, compare_cards, compute_health_figures
from rotemina.app.errors import HealthBookError
from rotemina.sim.calibration import SensorFigureEstimate
from rotemina.sim.errors import IdentificationError
from rotemina.sim.excitation import StepsExcitation, excite
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

NOON = datetime(2026, 11, 3, 12, tzinfo=UTC)


@pytest.fixture(scope="module")
def simulate_steps():
    """Function that simulates the same steps of zn with given effects."""
    robot = load_robot("rotemina")
    motion = excite(robot, {"zn": StepsExcitation(cycles=2, hold_s=0.4)}).record

    def simulate_steps(seed, *effects):
        return simulate(robot, effects, motion, np.random.default_rng(seed))

    return simulate_steps


@pytest.fixture(scope="module")
def healthy_figures(simulate_steps):
    return compute_health_figures(simulate_steps(1), "zn")


def _index_by_name(card):
    return {figure.name: figure for figure in card}


def test_card_figures_match_the_robot_file(healthy_figures):
    figures = _index_by_name(healthy_figures)
    assert figures["gain"].value == pytest.approx(1.0, abs=1e-3)
    assert figures["resonance"].value == pytest.approx(
        420.0, abs=2.0 * figures["resonance"].half_width
    )
    floor = load_robot("rotemina").axes["zn"].sensor.noise_floor
    assert figures["noise rms"].value == pytest.approx(floor, rel=0.2)
    assert figures["repeatability"].value < floor
    assert 0.0 <= figures["settling"].value < 0.2


def test_same_machine_shows_no_change(healthy_figures, simulate_steps):
    rows = compare_cards(compute_health_figures(simulate_steps(2), "zn"), healthy_figures)
    assert not any(row.changed for row in rows)
    assert all(row.before is not None for row in rows)


def test_changed_figures_are_marked(healthy_figures, simulate_steps):
    detuned = AxisEffect(axis="zn", id="resonance_mismatch", parameters={"frequency_error": -0.1})
    detuned_record = simulate_steps(2, detuned)
    changed = [
        row.now.name
        for row in compare_cards(compute_health_figures(detuned_record, "zn"), healthy_figures)
        if row.changed
    ]
    assert "resonance" in changed
    assert "gain" not in changed


def test_new_figure_is_not_marked_as_changed(healthy_figures):
    row = compare_cards(
        (SensorFigureEstimate("new", 1.0, 0.0, "1"), healthy_figures[0]), healthy_figures
    )
    assert row[0].before is None
    assert not row[0].changed


def test_record_at_rest_is_refused():
    constant = np.zeros(100)
    record = Record.from_signals(
        np.arange(100) * 1e-3, {("q", Tap.CMD): constant, ("q", Tap.MEAS): constant}, {"q": "m"}
    )
    with pytest.raises(IdentificationError, match="gives no figure of q"):
        compute_health_figures(record, "q")
    with pytest.raises(IdentificationError, match=r"no p\.cmd"):
        compute_health_figures(record, "p")


def test_cards_are_appended_and_invalid_lines_skipped(tmp_path, healthy_figures):
    book = HealthBook(tmp_path, "a robot")
    assert book.read_cards("zn") == ()
    book.add("zn", healthy_figures, "one.csv", NOON)
    with book.make_path("zn").open("a") as file:
        file.write('{"version": 1, "date": "2026')
        file.write("\n")
        file.write('{"version": 2, "date": "", "record": "", "figures": []}\n')
        file.write('{"version": 1, "date": "", "record": "", "figures": [["a", 1, -1, "m"]]}\n')
    book.add("zn", healthy_figures[:1], "two.csv", NOON)
    first, second = book.read_cards("zn")
    assert first.figures == healthy_figures
    assert (second.record, second.figures) == ("two.csv", healthy_figures[:1])
    assert book.make_path("zn").name == "a-robot--zn.jsonl"


def test_folder_in_place_of_the_file_is_reported(tmp_path):
    book = HealthBook(tmp_path, "r")
    book.make_path("q").mkdir(parents=True)
    with pytest.raises(HealthBookError, match="cannot be read"):
        book.read_cards("q")
