"""Parsing of the rows of a record file: each has a time and one value per channel.

There are two parsers. :meth:`RowParser.parse_strictly` is plain Python, defines the format and
finds the line and column of an error. :meth:`RowParser.parse` parses whole blocks at once with
pyarrow, and passes every block that is not clearly valid to the strict parser.
"""

from math import inf, isfinite

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import RecordError
from rotemina.sim.messages import (
    Message,
    join_messages,
    marked,
    message,
)
from rotemina.sim.records.fields import (
    BLANKS,
    GROUPED_NUMBER,
    NUMBER,
    SPREADSHEET_ERROR,
    UNFINISHED_NUMBER,
    is_comment,
    split_fields,
    without_padding,
)
from rotemina.sim.records.file_blocks import DEFAULT_LIMITS, LineBlock
from rotemina.sim.records.layout import FileLayout, is_repeated_header

# An error shows this many characters at the end of a line that was cut off.
_SHOWN_END_LENGTH = 20


class RowParser:
    """A parser of blocks of rows, which must be given in the order of the file.

    Parameters
    ----------
    name : name of the file in errors.
    layout : separator and columns.
    small_block_bytes : blocks up to this size are parsed only by the strict parser.
    """

    def __init__(
        self,
        name: str,
        layout: FileLayout,
        *,
        small_block_bytes: int = DEFAULT_LIMITS.small_block_bytes,
    ) -> None:
        self._name = name
        self._layout = layout
        self._per_si = layout.per_si
        self._small_block_bytes = small_block_bytes
        self._last_time_s = -inf
        self._decimal_sign = ""

    def parse(self, block: LineBlock) -> FloatArray:
        """Return the numbers (rows, columns) of a block in SI, time first.

        Raises
        ------
        RecordError
            If a row is refused; the message names file, line and column.
        """
        rows = None
        if len(block.data) > self._small_block_bytes:
            rows = self._parse_fast(block)
        if rows is None:
            rows = self.parse_strictly(block)
        if len(rows):
            self._last_time_s = float(rows[-1, 0])
        return rows

    def _parse_fast(self, block: LineBlock) -> FloatArray | None:
        """Return the result of the strict parser, or None if the strict parser must decide."""
        # pyarrow, which this module needs, is slow to import.
        from rotemina.sim.records import fast_rows

        data, comments = fast_rows.without_comments(block.data)
        sign = fast_rows.find_decimal_sign(data, self._layout.separator)
        if sign is None or (sign and self._decimal_sign not in ("", sign)):
            return None
        lines = block.lines - comments
        rows = fast_rows.parse(data, lines, self._layout.separator, len(self._layout.columns))
        if rows is None:
            return None
        for index, divisor in enumerate(self._per_si):
            if divisor != 1.0:
                rows[:, index] /= divisor
        time_s = rows[:, 0]
        if len(rows) and (time_s[0] <= self._last_time_s or (time_s[1:] <= time_s[:-1]).any()):
            return None
        self._decimal_sign = self._decimal_sign or sign
        return rows

    def parse_strictly(self, block: LineBlock) -> FloatArray:
        """Parse a block row by row in plain Python, with the same result as :meth:`parse`."""
        rows: list[list[float]] = []
        # If tabs are separators, a line of tabs is a row of missing values.
        blanks = " " if self._layout.separator == "\t" else BLANKS
        last_time_s = self._last_time_s
        for line, data in enumerate(block.data.split(b"\n")[:-1], start=block.first_line):
            text = decode_line(data, self._name, line)
            if not text.strip(blanks) or is_comment(text):
                continue
            try:
                row = self._parse_row(text, line)
            except RecordError:
                self._refuse_second_header(text, line)
                if block.unterminated and line == block.last_line:
                    self._refuse_cut_row(text, line)
                raise
            if row[0] <= last_time_s:
                raise self._make_error(
                    line,
                    0,
                    message(
                        "engine",
                        "time {time} s does not increase after {last} s; each row must be later "
                        "than the one before",
                    ).fill(time=repr(row[0]), last=repr(last_time_s)),
                )
            last_time_s = row[0]
            rows.append(row)
        return np.array(rows, dtype=np.float64).reshape(len(rows), len(self._per_si))

    def _refuse_second_header(self, text: str, line: int) -> None:
        if is_repeated_header(text, self._layout.separator):
            raise RecordError(
                "{name}:{line}: a second header; the file contains two logs: move the lines "
                "from here on to a separate file",
                name=self._name,
                line=line,
            ) from None

    def _refuse_cut_row(self, text: str, line: int) -> None:
        fields = self._split_fields(text)
        is_short = len(fields) < len(self._per_si)
        has_open_quote = text.count('"') % 2 == 1
        if (
            is_short
            or has_open_quote
            or UNFINISHED_NUMBER.fullmatch(fields[-1].replace(",", ".", 1))
        ):
            raise RecordError(
                "{name}:{line}: the file ends inside this line, at {end}: it was cut off; copy "
                "it again, or delete the line",
                name=self._name,
                line=line,
                end=repr(text[-_SHOWN_END_LENGTH:]),
            ) from None

    def _split_fields(self, text: str) -> list[str]:
        return without_padding(split_fields(text, self._layout.separator), len(self._per_si))

    def _parse_row(self, text: str, line: int) -> list[float]:
        fields = self._split_fields(text)
        if len(fields) != len(self._per_si):
            raise self._make_length_error(line, fields)
        return [
            self._parse_number(field, line, index) / divisor
            for index, (field, divisor) in enumerate(zip(fields, self._per_si, strict=True))
        ]

    def _parse_number(self, field: str, line: int, index: int) -> float:
        self._check_decimal_sign(field, line, index)
        text = field.replace(",", ".", 1)
        if NUMBER.fullmatch(text) is None:
            raise self._make_error(line, index, _describe_fault(field))
        value = float(text)
        if not isfinite(value):
            raise self._make_error(
                line,
                index,
                message("engine", "value {value} exceeds what float64 holds").fill(
                    value=repr(field)
                ),
            )
        return value

    def _check_decimal_sign(self, field: str, line: int, index: int) -> None:
        # If commas are separators, a quoted "1,234" may mean a thousand or a little more than one.
        is_ambiguous = self._layout.separator == "," and "," in field and not self._decimal_sign
        if is_ambiguous and GROUPED_NUMBER.fullmatch(field) is not None:
            raise self._make_error(line, index, _describe_thousands_separator(field))
        # If both signs were accepted in one file, the thousands separator of "1,234" next to "0.5"
        # would be taken as a decimal sign.
        for sign in ",.":
            if sign in field:
                self._decimal_sign = self._decimal_sign or sign
                if sign != self._decimal_sign:
                    raise self._make_error(
                        line,
                        index,
                        message(
                            "engine",
                            "value {value} has {sign} where the numbers before have {before}; use "
                            "one decimal sign and no thousands separators",
                        ).fill(value=repr(field), sign=repr(sign), before=repr(self._decimal_sign)),
                    )

    def _make_length_error(self, line: int, fields: list[str]) -> RecordError:
        column_count = len(self._per_si)
        separator = {"\t": marked("engine", "tabs"), " ": marked("engine", "blanks")}.get(
            self._layout.separator, repr(self._layout.separator)
        )
        advice = [
            message("engine", "separate {count} columns by {separator}").fill(
                count=column_count, separator=separator
            )
        ]
        if self._layout.separator == "," and column_count < len(fields) <= 2 * column_count:
            advice.append(
                message("engine", "if the commas are decimal signs, separate columns by ';'")
            )
        return self._make_error(
            line,
            min(len(fields), column_count),
            message(
                "engine", "the row has {count} fields where the header names {wanted}; {advice}"
            ).fill(count=len(fields), wanted=column_count, advice=join_messages(advice, "; ")),
        )

    def _make_error(self, line: int, index: int, problem: str) -> RecordError:
        names = self._layout.names
        column = names[index] if index < len(names) else str(index + 1)
        return RecordError(
            "{name}:{line}:{column}: {what}",
            name=self._name,
            line=line,
            column=column,
            what=problem,
        )


def decode_line(data: bytes, name: str, line: int) -> str:
    """Return one line as text, without its line end.

    Raises
    ------
    RecordError
        If it is not UTF-8, or contains a carriage return.
    """
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise RecordError(
            "{name}:{line}:byte {start}: {data} is not UTF-8; save the file as UTF-8",
            name=name,
            line=line,
            start=error.start + 1,
            data=repr(data[error.start : error.start + 1]),
        ) from error
    text = text.removesuffix("\r")
    if "\r" in text:
        raise RecordError(
            "{name}:{line}: a carriage return is inside the line; end lines with LF or CRLF",
            name=name,
            line=line,
        )
    return text


def _describe_fault(field: str) -> str:
    if not field:
        return marked(
            "engine",
            "the value is missing; write a number, even for a dropout of the sensor",
        )
    if field.lower().lstrip("+-") in ("nan", "inf", "infinity"):
        return message("engine", "value {value} is not finite; write a finite number").fill(
            value=repr(field)
        )
    if SPREADSHEET_ERROR.fullmatch(field) is not None:
        return message(
            "engine",
            "value {value} is a spreadsheet's mark of a missing value or an error; write a number, "
            "or delete the row",
        ).fill(value=repr(field))
    if GROUPED_NUMBER.fullmatch(field) is not None:
        return _describe_thousands_separator(field)
    if '"' in field:
        return message(
            "engine",
            "value {value} has an unpaired quote; remove it",
        ).fill(value=repr(field))
    return message(
        "engine", "value {value} is not a plain decimal number; write it like -12.5 or 3e-6"
    ).fill(value=repr(field))


def _describe_thousands_separator(field: str) -> Message:
    return message("engine", "value {value} has a thousands separator; remove it").fill(
        value=repr(field)
    )
