"""Formats findings as text for the clipboard and as a CSV file."""

import csv
import io

from rotemina.plugins.identification.findings import AnalysisFindings


def to_text(findings: AnalysisFindings, analysis_name: str) -> str:
    """Return the table of key values as aligned text, with what was analysed and all notices."""
    rows = [findings.head, *findings.rows] if findings.rows else []
    widths = [max(len(row[column]) for row in rows) for column in range(len(findings.head))]
    table_lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    question_lines = [
        f"{name}: {value}" for name, value in _describe_question(findings, analysis_name)
    ]
    notice_lines = [f"notice: {text}" for text in findings.notices]
    return "\n".join([*question_lines, *table_lines, *notice_lines]) + "\n"


def to_csv(findings: AnalysisFindings, analysis_name: str) -> str:
    """Return CSV text: ``# key: value`` lines, followed by the columns of numbers.

    The lines say what was analysed, and contain the key values and all notices.
    """
    file = io.StringIO()
    for name, value in _describe_question(findings, analysis_name):
        file.write(f"# {name}: {value}\n")
    for name, *values in findings.rows:
        file.write(f"# {name}: {'; '.join(value for value in values if value)}\n")
    for text in findings.notices:
        file.write(f"# notice: {_to_one_line(text)}\n")
    writer = csv.writer(file, lineterminator="\n")
    if findings.columns:
        writer.writerow([column.heading for column in findings.columns])
        rows = zip(*(column.values for column in findings.columns), strict=True)
        writer.writerows(["" if value is None else repr(value) for value in row] for row in rows)
    return file.getvalue()


def _describe_question(findings: AnalysisFindings, analysis_name: str) -> list[tuple[str, str]]:
    question = findings.question
    pair = f"{question.axis}.{question.input_tap} to {question.axis}.{question.output_tap}"
    return [
        ("identification", analysis_name),
        ("record", _to_one_line(question.name)),
        ("pair", pair),
    ]


def _to_one_line(text: str) -> str:
    return " ".join(text.split())
