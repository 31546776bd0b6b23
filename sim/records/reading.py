"""Import of record and trajectory files."""

import re
from collections.abc import Iterable, Iterator
from os import PathLike, fspath

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.layout import (
    EXAMPLE,
    SEPARATORS,
    Column,
    Layout,
    header_separator,
    looks_like_header,
    parse_columns,
    row_separator,
)
from rotemina.sim.records.metadata import VERSION_KEY, add_comment
from rotemina.sim.records.record import Record, RecordError
from rotemina.sim.records.rows import SMALL_BLOCK_BYTES, RowParser, decode_line
from rotemina.sim.records.source import LIMITS, Block, Limits, open_blocks
from rotemina.sim.robot.model import Robot
