"""Imports without PySide's source search still support Qt feature switches."""

import subprocess
import sys

PROGRAM = """
import linecache, sys
from pathlib import Path

import PySide6.QtCore

from rotemina.app.shell.startup.qt_setup import skip_source_search

skip_source_search()
sys.path.insert(0, sys.argv[1])
import numba

print(sum("numba" in name for name in linecache.cache))
import with_feature, without_feature

print(with_feature.NAMES, without_feature.names())
"""
WITH_FEATURE = """
from PySide6.QtCore import QObject
from __feature__ import snake_case

NAMES = hasattr(QObject, "object_name"), hasattr(QObject, "objectName")
"""
WITHOUT_FEATURE = """
from PySide6.QtCore import QObject


def names():
    return hasattr(QObject, "object_name"), hasattr(QObject, "objectName")
"""


def test_no_source_is_read_and_features_still_work(tmp_path):
    (tmp_path / "with_feature.py").write_text(WITH_FEATURE)
    (tmp_path / "without_feature.py").write_text(WITHOUT_FEATURE)
    result = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(tmp_path)],
        check=True,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert result.stdout.split("\n")[:2] == ["0", "(True, False) (False, True)"]
