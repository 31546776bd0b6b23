"""Carry the German over to reworded English: ``python .ci/translations.py open | fill | lost``.

``make languages`` forgets the translation of every text that is no longer in the source, so a
reworded English sentence comes back without its German. These commands bring it back:

``open``
    Print a table (CSV) of the texts without a translation. Each row also shows the most similar
    English text that has gone since ``--base`` (a commit, by default HEAD) and its German.
``fill TABLE``
    Write the column ``german`` of such a table into the files of texts. Rows where it is empty are
    skipped. Run ``make languages`` afterwards.
``lost``
    Print the texts that had a translation at ``--base`` and are gone, for a last look at what was
    deleted and what was only reworded.
"""

import argparse
import csv
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping
from difflib import SequenceMatcher
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "resources" / "languages" / "de"
COLUMNS = ("file", "context", "english", "german", "earlier_english", "earlier_german")
MIN_SIMILARITY = 0.5  # of two English texts, 0 to 1; below it a suggestion only distracts
HEADER = '<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n'


class Text(NamedTuple):
    """An English text and where it is used."""

    file: str
    context: str
    english: str


def main(words: list[str]) -> int:
    """Run one command and return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    for name in ("open", "lost"):
        commands.add_parser(name).add_argument("--base", default="HEAD", help="a commit")
    commands.add_parser("fill").add_argument("table", type=Path)
    options = parser.parse_args(words)
    if options.command == "fill":
        return fill(options.table)
    present, before = read_folder(), read_commit(options.base)
    lost = {text: german for text, german in before.items() if german and text not in present}
    table = csv.writer(sys.stdout)
    table.writerow(COLUMNS)
    if options.command == "lost":
        table.writerows((*text[:2], "", "", text.english, german) for text, german in lost.items())
        return 0
    for text, german in present.items():
        if not german:
            table.writerow((*text, "", *nearest(text, lost)))
    return 0


def read_folder() -> dict[Text, str]:
    """Return every text of the files as they are now, with its German ("" where it has none)."""
    return {
        text: german
        for path in sorted(FOLDER.glob("*.ts"))
        for text, german in texts(path.name, path.read_text("utf-8"))
    }


def read_commit(base: str) -> dict[Text, str]:
    """Return every text of the files as they were at a commit."""
    folder = FOLDER.relative_to(ROOT).as_posix()
    names = _git("ls-tree", "--name-only", base, f"{folder}/").split()
    return {
        text: german
        for name in names
        if name.endswith(".ts")
        for text, german in texts(Path(name).name, _git("show", f"{base}:{name}"))
    }


def texts(file: str, content: str) -> Iterator[tuple[Text, str]]:
    """Yield the texts of a file with their German."""
    for context in ET.fromstring(content).iter("context"):  # noqa: S314 (of this repository)
        for message in context.iter("message"):
            translation = message.find("translation")
            finished = translation is not None and translation.get("type") is None
            german = (translation.text or "") if translation is not None and finished else ""
            yield (
                Text(file, context.findtext("name", ""), message.findtext("source", "")),
                german,
            )


def nearest(text: Text, lost: Mapping[Text, str]) -> tuple[str, str]:
    """Return the lost text that is most like a new one, with its German; two "" if none is.

    Texts of the same context come first: a word moved within one page keeps its meaning.
    """
    matcher = SequenceMatcher(autojunk=False)
    matcher.set_seq2(text.english)
    best, best_rank = ("", ""), (MIN_SIMILARITY, False)
    for other, german in lost.items():
        matcher.set_seq1(other.english)
        if matcher.real_quick_ratio() < best_rank[0] or matcher.quick_ratio() < best_rank[0]:
            continue
        rank = (matcher.ratio(), other.context == text.context)
        if rank > best_rank:
            best, best_rank = (other.english, german), rank
    return best


def fill(table: Path) -> int:
    """Write the translations of a table into the files; return 1 if a row fits no open text."""
    with table.open(encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row.get("german")]
    given = {Text(row["file"], row["context"], row["english"]): row["german"] for row in rows}
    faults = [
        f"{text.file}: {text.english!r} has other fields than its German {german!r}"
        for text, german in given.items()
        if fields(text.english) != fields(german)
    ]
    filled = set() if faults else _write(given)
    if not faults:
        faults = [f"{text.file}: no open text {text.english!r}" for text in given.keys() - filled]
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{len(filled)} translations filled")
    return 1 if faults else 0


def fields(text: str) -> list[str]:
    """Return the ``{fields}`` of a template in alphabetical order."""
    return sorted(re.findall(r"\{[^{}]*\}", text))


def _write(given: Mapping[Text, str]) -> set[Text]:
    """Write translations into the files; return the texts that were there to be filled."""
    filled = set()
    for path in sorted(FOLDER.glob("*.ts")):
        root = ET.fromstring(path.read_text("utf-8"))  # noqa: S314 (of this repository)
        before = len(filled)
        for context in root.iter("context"):
            for message in context.iter("message"):
                text = Text(path.name, context.findtext("name", ""), message.findtext("source", ""))
                translation = message.find("translation")
                if translation is not None and translation.get("type") and text in given:
                    translation.text = given[text]
                    del translation.attrib["type"]
                    filled.add(text)
        if len(filled) > before:
            path.write_text(HEADER + ET.tostring(root, encoding="unicode") + "\n", "utf-8")
    return filled


def _git(*words: str) -> str:
    done = subprocess.run(
        ["git", "-C", str(ROOT), *words],  # noqa: S607 (found in the PATH)
        capture_output=True,
        check=True,
        encoding="utf-8",
    )
    return done.stdout


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
