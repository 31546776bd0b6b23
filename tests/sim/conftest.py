"""Fixtures: records of real machines, and a worn robot."""

import runpy
import sys
from dataclasses import replace

import pytest

from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot


@pytest.fixture(scope="session")
def real_dir(shared_dir, tmp_path_factory):
    """Folder of the records of real machines, converted by their own script."""
    folder = tmp_path_factory.mktemp("real")
    arguments, sys.argv = sys.argv, ["convert.py", str(folder)]
    try:
        runpy.run_path(str(shared_dir / "data" / "convert.py"), run_name="__main__")
    finally:
        sys.argv = arguments
    return folder


@pytest.fixture(scope="session")
def worn_robot():
    """The nominal robot with hysteresis of 12 % and creep of 2 % per decade on zn."""
    effects = (
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6}),
        AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),
    )
    return replace(load_robot("rotemina"), effects=effects)
