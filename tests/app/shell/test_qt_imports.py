"""Imports after PySide's own: no search of sources, and features all the same."""

import subprocess
import sys

PROGRAM = """
import linecache, sys
from pathlib import Path

import PySide6.QtCore

from rotemina.app.shell.qt_imports import spare_source_search

spare_source_search()
sys.path.insert(0, sys.argv[1])
import numba

print(sum("numba" in name for name in linecache.cache))
import switches, switches_not

print(switches.NAMES, switches_not.names())
"""
SWITCHES = """
from PySide6.QtCore import QObject
from __feature__ import snake_case

NAMES = hasattr(QObject, "object_name"), hasattr(QObject, "objectName")
"""
SWITCHES_NOT = """
from PySide6.QtCore import QObject


def names():
    return hasattr(QObject, "object_name"), hasattr(QObject, "objectName")
"""


def test_no_source_is_read_and_features_can_be_switched(tmp_path):
    (tmp_path / "switches.py").write_text(SWITCHES)
    (tmp_path / "switches_not.py").write_text(SWITCHES_NOT)
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(tmp_path)],
        check=True,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.stdout.split("\n")[:2] == ["0", "(True, False) (False, True)"]
