"""The list of cells: order, numbers, outcomes, and its export."""

import csv
import io
from dataclasses import asdict, replace

import pytest

from rotemina.app.motion.penetration import cell_list
from rotemina.app.motion.penetration.cell_list import CellList, Outcome
from rotemina.app.motion.penetration.parameters import PenetrationError, PenetrationParameters
from rotemina.app.motion.penetration.run_log import PenetrationRun, Verdict
from rotemina.app.motion.penetration.thrust import ThrustMeasured
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
RUN = PenetrationRun(
    started="2026-11-21T10:00:05+00:00",
    robot="RoTeMiNa",
    driver="simulator",
    parameters=asdict(PenetrationParameters()),
    verdict=Verdict.DONE,
    reason="",
    phases=(),
    thrust=ThrustMeasured(4.95e-5, 3e-7, 2e-3, 5.5e-4, 8.1e-4, 1000.0),
)


def place(x):
    return {axis: 0.5 * sum(one.range) for axis, one in ROBOT.axes.items()} | {"x": x}


def outcomes(cells):
    return [one.outcome for one in cells.cells]


@pytest.fixture
def cells():
    """Three of them, at the first."""
    made = CellList()
    for x in (0.01, 0.02, 0.03):
        made.add(place(x))
    made.go_on(made.following())
    return made


def test_they_are_gone_to_in_order_and_those_left_behind_come_at_the_end(cells):
    assert cells.current.number == 1
    cells.go_on(cells.cells[1])
    cells.take(2, RUN)
    cells.go_on(cells.following())
    assert cells.current.number == 3
    cells.skip()
    assert cells.following().number == 1
    cells.go_on(cells.following())
    assert cells.following() is None
    assert outcomes(cells) == [Outcome.WAITING, Outcome.DONE, Outcome.SKIPPED]


def test_a_number_stays_that_of_its_cell(cells):
    cells.remove(2)
    assert [one.number for one in cells.cells] == [1, 3]
    assert cells.add(place(0.04)).number == 4
    cells.remove(1)
    assert cells.current is None
    assert cells.following().number == 3


def test_what_came_of_it_is_exported_in_si(cells):
    cells.take(1, RUN)
    no_contact = replace(RUN, verdict=Verdict.FAILED, reason="no contact, 12,5 µm", thrust=None)
    cells.take(2, no_contact)
    head, *rows = csv.reader(io.StringIO(cells.as_csv(ROBOT)))
    assert head[:2] == ["cell", "x [m]"]
    assert head[-4:] == ["outcome", "depth [m]", "started", "reason"]
    assert [float(row[1]) for row in rows] == [0.01, 0.02, 0.03]
    assert rows[0][-4:] == ["done", "4.95e-05", RUN.started, ""]
    assert rows[1][-4:] == ["failed", "", RUN.started, "no contact, 12,5 µm"]
    assert rows[2][-4:] == ["waiting", "", "", ""]


def test_a_place_that_nobody_knows_and_one_too_many_are_refused(cells, monkeypatch):
    with pytest.raises(PenetrationError, match="the positions of the axes are unknown"):
        cells.add({})
    monkeypatch.setattr(cell_list, "MOST_CELLS", 3)
    with pytest.raises(PenetrationError, match="the list has 3; remove one"):
        cells.add(place(0.05))
