"""Health cards: what a record tells of an axis, kept, and compared with the last one."""

from datetime import UTC, datetime

import numpy as np
import pytest

from rotemina.app.calibration.health import card_of, compared_cards
from rotemina.app.calibration.health_book import HealthBook, HealthBookError
from rotemina.sim.calibration.sensor_calibration import Figure
from rotemina.sim.excitation.generator import excite
from rotemina.sim.excitation.staircase_steps_prbs import Steps
from rotemina.sim.identification.errors import IdentificationError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

NOON = datetime(2026, 11, 3, 12, tzinfo=UTC)


@pytest.fixture(scope="module")
def steps():
    """Return records of the same steps of zn, with effects."""
    robot = load_robot("rotemina")
    motion = excite(robot, {"zn": Steps(cycles=2, hold_s=0.4)}).record

    def make(seed, *effects):
        return simulate(robot, effects, motion, np.random.default_rng(seed))

    return make


@pytest.fixture(scope="module")
def healthy(steps):
    return card_of(steps(1), "zn")


def _named(card):
    return {each.name: each for each in card}


def test_a_card_has_the_figures_of_the_robot_file(healthy):
    card = _named(healthy)
    assert card["gain"].value == pytest.approx(1.0, abs=1e-3)
    assert card["resonance"].value == pytest.approx(420.0, abs=2.0 * card["resonance"].half_width)
    floor = load_robot("rotemina").axes["zn"].sensor.noise_floor
    assert card["noise rms"].value == pytest.approx(floor, rel=0.2)
    assert card["repeatability"].value < floor
    assert 0.0 <= card["settling"].value < 0.2


def test_the_same_machine_has_not_changed(healthy, steps):
    again = compared_cards(card_of(steps(2), "zn"), healthy)
    assert not any(row.changed for row in again)
    assert all(row.before is not None for row in again)


def test_what_has_changed_is_told(healthy, steps):
    detuned = AxisEffect(axis="zn", id="resonance_mismatch", parameters={"frequency_error": -0.1})
    softer = steps(2, detuned)
    changed = [
        row.now.name for row in compared_cards(card_of(softer, "zn"), healthy) if row.changed
    ]
    assert "resonance" in changed
    assert "gain" not in changed


def test_a_figure_that_is_new_is_no_change(healthy):
    row = compared_cards((Figure("new", 1.0, 0.0, "1"), healthy[0]), healthy)
    assert row[0].before is None
    assert not row[0].changed


def test_a_record_that_tells_nothing_is_refused():
    still = np.zeros(100)
    record = Record.from_signals(
        np.arange(100) * 1e-3, {("q", Tap.CMD): still, ("q", Tap.MEAS): still}, {"q": "m"}
    )
    with pytest.raises(IdentificationError, match="gives no figure of q"):
        card_of(record, "q")
    with pytest.raises(IdentificationError, match=r"no p\.cmd"):
        card_of(record, "p")


def test_cards_are_added_and_a_torn_line_is_passed_over(tmp_path, healthy):
    book = HealthBook(tmp_path, "a robot")
    assert book.cards("zn") == ()
    book.add("zn", healthy, "one.csv", NOON)
    with book.path("zn").open("a") as file:
        file.write('{"version": 1, "date": "2026')
        file.write("\n")
        file.write('{"version": 2, "date": "", "record": "", "figures": []}\n')
        file.write('{"version": 1, "date": "", "record": "", "figures": [["a", 1, -1, "m"]]}\n')
    book.add("zn", healthy[:1], "two.csv", NOON)
    first, second = book.cards("zn")
    assert first.figures == healthy
    assert (second.record, second.figures) == ("two.csv", healthy[:1])
    assert book.path("zn").name == "a-robot--zn.jsonl"


def test_a_folder_in_the_files_place_is_told(tmp_path):
    book = HealthBook(tmp_path, "r")
    book.path("q").mkdir(parents=True)
    with pytest.raises(HealthBookError, match="cannot be read"):
        book.cards("q")
