"""The fields of one line of a record file, as any program may write them.

The fields of a line are separated by one character. A field may be enclosed in double quotes, with
each quote inside doubled, and may have blanks around it. A spreadsheet fills short lines with empty
fields.
"""

import re

# In the order in which they are tried: a comma may also be a decimal sign, and a blank may also be
# padding.
SEPARATORS = (";", "\t", ",", " ")
BLANKS = " \t"
# Blanks, and the no-break and narrow spaces of typeset numbers, which look like blanks.
PADDING = BLANKS + "\u00a0\u2007\u2009\u202f"
_BLANK_TABLE = str.maketrans(dict.fromkeys(PADDING[len(BLANKS) :], " "))

# ASCII digits with one sign, one point, one exponent: no "1_000", no "0x10", no "nan".
NUMBER = re.compile(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
# A number that is cut off, because no number ends like this.
UNFINISHED_NUMBER = re.compile(r"[+-]?\.?|[+-]?(?:\d+\.?\d*|\.\d+)[eE][+-]?", re.ASCII)
# Digits in groups of three: "1,234", "1.234.567", "12 345,6", "1'234".
GROUPED_NUMBER = re.compile(
    rf"[+-]?[1-9]\d{{0,2}}(?:[,.'’{PADDING}]\d{{3}})+(?:[.,]\d+)?", re.ASCII
)
# The marks of spreadsheets for a value that is missing or cannot be calculated: "#N/A", "#DIV/0!".
SPREADSHEET_ERROR = re.compile(r"#(?:N/?[AV]|[^\W\d_]+(?:/0)?[!?])", re.IGNORECASE)
_ERROR_AS_FIRST_FIELD = re.compile(
    rf'"?{SPREADSHEET_ERROR.pattern}"?[ \t]*+(?:[;,\t]|(?<=[ \t])[-+.\d])', re.IGNORECASE
)
NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)

# A spreadsheet quotes a whole comment that contains a separator. No heading or number begins with
# these marks.
COMMENT_MARKS = ("#", "%", "//", '"#')
COMMENT_BEGIN = rb'[ \t]*(?:"?#|%|//)'
_QUOTED_BEGIN = re.compile(r'"((?:[^"]|"")*+)"')
_SEPARATOR_LINE = re.compile(r'"?sep=(?P<sign>[^"])"?[;,]*', re.IGNORECASE)


def _compile_field_pattern(separator: str) -> re.Pattern[str]:
    padding = PADDING.replace(separator, "")
    excluded, end = (BLANKS, f"[{BLANKS}]+") if separator == " " else (separator, separator)
    return re.compile(
        rf'[{padding}]*+(?:"(?P<quoted>(?:[^"]|"")*+)"|(?P<plain>[^"{excluded}]*+))[{padding}]*+'
        rf"(?P<end>{end}|\Z)"
    )


_FIELDS = {separator: _compile_field_pattern(separator) for separator in SEPARATORS}


def with_plain_blanks(text: str) -> str:
    """Return a text with a blank in place of each no-break or narrow space."""
    return text if text.isascii() else text.translate(_BLANK_TABLE)


def without_quotes(text: str) -> str:
    """Return the quoted part at the beginning of a text, or the whole text if there is none."""
    match = _QUOTED_BEGIN.match(text)
    return match[1].replace('""', '"') if match else text


def is_comment(line: str) -> bool:
    """Return whether a line is a comment, in the style of this or of another program."""
    return line.lstrip(BLANKS).startswith(COMMENT_MARKS)


def is_row_with_error(line: str) -> bool:
    """Return whether a line is a row that begins with a spreadsheet's error mark, not a comment."""
    return _ERROR_AS_FIRST_FIELD.match(line.lstrip(BLANKS)) is not None


def is_empty(line: str) -> bool:
    """Return whether a line is empty; a spreadsheet writes an empty line as separators."""
    return not line.strip(PADDING + ';,"')


def parse_separator_line(line: str) -> str | None:
    """Return the separator that a line such as ``sep=;`` names, or None for any other line."""
    match = _SEPARATOR_LINE.fullmatch(line.strip("\r\n"))
    return match["sign"] if match else None


def split_fields(line: str, separator: str) -> list[str]:
    """Split one line into fields without quotes and without the blanks around them.

    If the quotes of a line do not pair, they are treated as ordinary characters.
    """
    if '"' in line:
        fields = _split_quoted(line, separator)
        if fields is not None:
            return fields
    if separator == " ":
        return [field.strip(PADDING) for field in re.split(r"[ \t]+", line.strip(BLANKS))]
    return [field.strip(PADDING) for field in line.split(separator)]


def _split_quoted(line: str, separator: str) -> list[str] | None:
    """Return the fields, or None if a quote is not at the beginning or end of a field."""
    fields, position = [], 0
    if separator == " ":
        line = line.strip(BLANKS)
    while match := _FIELDS[separator].match(line, position):
        quoted = match["quoted"]
        field = match["plain"] if quoted is None else quoted.replace('""', '"')
        fields.append(field.strip(PADDING))
        if not match["end"]:
            return fields
        position = match.end()
    return None


def without_padding(fields: list[str], count: int) -> list[str]:
    """Return fields without empty ones at the end, but at least the first ``count``.

    A separator at the end of a line adds an empty field. A spreadsheet fills a line up to the width
    of its widest line.
    """
    end = len(fields)
    while end > count and not fields[end - 1]:
        end -= 1
    return fields[:end]
