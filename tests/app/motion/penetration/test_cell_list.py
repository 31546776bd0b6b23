"""List of cells: order, numbers, outcomes and export."""

import csv
import io
from dataclasses import asdict, replace

import pytest

from rotemina.app.errors import PenetrationError
from rotemina.app.motion.penetration import (
    CellList,
    CellOutcome,
    PenetrationParameters,
    PenetrationRun,
    PenetrationVerdict,
    cell_list,
)
from rotemina.app.motion.penetration.thrust import MeasuredThrust
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
RUN = PenetrationRun(
    started="2026-11-21T10:00:05+00:00",
    robot="RoTeMiNa",
    driver="simulator",
    parameters=asdict(PenetrationParameters()),
    verdict=PenetrationVerdict.DONE,
    reason="",
    phases=(),
    thrust=MeasuredThrust(4.95e-5, 3e-7, 2e-3, 5.5e-4, 8.1e-4, 1000.0),
)


def make_positions(x):
    return {axis: 0.5 * sum(model.range) for axis, model in ROBOT.axes.items()} | {"x": x}


def list_outcomes(cells):
    return [cell.outcome for cell in cells.cells]


@pytest.fixture
def cells():
    """Three cells; the first is the current one."""
    three_cells = CellList()
    for x in (0.01, 0.02, 0.03):
        three_cells.add(make_positions(x))
    three_cells.set_current(three_cells.find_next_waiting())
    return three_cells


def test_cells_are_visited_in_order_and_skipped_ones_come_last(cells):
    assert cells.current.number == 1
    cells.set_current(cells.cells[1])
    cells.note_outcome(2, RUN)
    cells.set_current(cells.find_next_waiting())
    assert cells.current.number == 3
    cells.skip_current()
    assert cells.find_next_waiting().number == 1
    cells.set_current(cells.find_next_waiting())
    assert cells.find_next_waiting() is None
    assert list_outcomes(cells) == [CellOutcome.WAITING, CellOutcome.DONE, CellOutcome.SKIPPED]


def test_a_cell_keeps_its_number(cells):
    cells.remove(2)
    assert [cell.number for cell in cells.cells] == [1, 3]
    assert cells.add(make_positions(0.04)).number == 4
    cells.remove(1)
    assert cells.current is None
    assert cells.find_next_waiting().number == 3


def test_outcomes_are_exported_in_si_units(cells):
    cells.note_outcome(1, RUN)
    no_contact = replace(
        RUN, verdict=PenetrationVerdict.FAILED, reason="no contact, 12,5 µm", thrust=None
    )
    cells.note_outcome(2, no_contact)
    head, *rows = csv.reader(io.StringIO(cells.to_csv(ROBOT)))
    assert head[:2] == ["cell", "x [m]"]
    assert head[-4:] == ["outcome", "depth [m]", "started", "reason"]
    assert [float(row[1]) for row in rows] == [0.01, 0.02, 0.03]
    assert rows[0][-4:] == ["done", "4.95e-05", RUN.started, ""]
    assert rows[1][-4:] == ["failed", "", RUN.started, "no contact, 12,5 µm"]
    assert rows[2][-4:] == ["waiting", "", "", ""]


def test_unknown_positions_and_too_many_cells_are_refused(cells, monkeypatch):
    with pytest.raises(PenetrationError, match="the positions of the axes are unknown"):
        cells.add({})
    monkeypatch.setattr(cell_list, "MAX_CELL_COUNT", 3)
    with pytest.raises(PenetrationError, match="the list is full"):
        cells.add(make_positions(0.05))
