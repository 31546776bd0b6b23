"""Find texts of errors, and translate reworded texts: ``.ci/translations.py raised | open | …``.

``make languages`` deletes the translation of every text that is no longer in the source, so a
reworded English sentence has lost its German. These commands help to restore it:

``open``
    Print a table (CSV) of the texts without a translation. Each row also shows the most similar
    English text that was deleted since ``--base`` (a commit, by default HEAD) and its German.
``fill TABLE``
    Write the column ``german`` of such a table into the translation files. Rows without German are
    skipped. Run ``make languages`` afterwards.
``raised PATH …``
    Print a call of ``translate`` for each literal with which these files or folders create an
    error, because Qt's tool does not know that it is a text: ``raise LimitError("{axis}: …")``.
``lost``
    Print the deleted texts that had a translation at ``--base``, to check which were really deleted
    and which only reworded.
"""

import argparse
import ast
import csv
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping
from difflib import SequenceMatcher
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "resources" / "languages" / "de"
COLUMNS = ("file", "context", "english", "german", "earlier_english", "earlier_german")
# Less similar English texts are not suggested (ratio of difflib, 0 to 1).
MIN_SIMILARITY = 0.5
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
    commands.add_parser("raised").add_argument("paths", nargs="+", type=Path)
    options = parser.parse_args(words)
    if options.command == "fill":
        return fill(options.table)
    if options.command == "raised":
        for context, text in find_raised_texts(options.paths):
            print(f"translate({json.dumps(context)}, {json.dumps(text, ensure_ascii=False)})")
        return 0
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


def find_raised_texts(paths: Iterable[Path]) -> Iterator[tuple[str, str]]:
    """Yield context and template of each literal with which these files create an error."""
    contexts = read_error_contexts()
    for path in paths:
        for file in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            for call in ast.walk(ast.parse(file.read_text("utf-8"))):
                if isinstance(call, ast.Call) and call.args:
                    name = getattr(call.func, "attr", getattr(call.func, "id", ""))
                    text = call.args[0]
                    if name in contexts and isinstance(text, ast.Constant) and text.value:
                        yield contexts[name], text.value


def read_error_contexts() -> dict[str, str]:
    """Return the context of every error class of this program whose text is a message."""
    bases, own = {}, {}
    for layer in ("app", "drivers", "plugins", "sim"):
        for file in (ROOT / layer).rglob("*.py"):
            for node in ast.walk(ast.parse(file.read_text("utf-8"))):
                if isinstance(node, ast.ClassDef):
                    bases[node.name] = [ast.unparse(base).rpartition(".")[2] for base in node.bases]
                    for context in _read_context(node):
                        own[node.name] = context

    def find_context(name: str) -> str | None:
        if name in own:
            return own[name]
        return next(filter(None, map(find_context, bases.get(name, ()))), None)

    return {name: context for name in bases if (context := find_context(name))}


def _read_context(definition: ast.ClassDef) -> Iterator[str]:
    """Yield the value of the class attribute ``context``, if the class sets it."""
    for node in definition.body:
        targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
        if getattr(targets[0], "id", "") == "context" and isinstance(node.value, ast.Constant):
            yield node.value.value


def read_folder() -> dict[Text, str]:
    """Return every text of the present files with its German, or "" if it has none."""
    return {
        text: german
        for path in sorted(FOLDER.glob("*.ts"))
        for text, german in texts(path.name, path.read_text("utf-8"))
    }


def read_commit(base: str) -> dict[Text, str]:
    """Return every text of the files at a commit with its German, or "" if it has none."""
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
    """Return the deleted text that is most similar to a new one, with its German, or two "".

    If two are equally similar, that of the same context is preferred.
    """
    matcher = SequenceMatcher(autojunk=False)
    matcher.set_seq2(text.english)
    best_match, best_rank = ("", ""), (MIN_SIMILARITY, False)
    for other, german in lost.items():
        matcher.set_seq1(other.english)
        if matcher.real_quick_ratio() < best_rank[0] or matcher.quick_ratio() < best_rank[0]:
            continue
        rank = (matcher.ratio(), other.context == text.context)
        if rank > best_rank:
            best_match, best_rank = (other.english, german), rank
    return best_match


def fill(table: Path) -> int:
    """Write the translations of a table into the files; return 1 if a row matches no open text."""
    with table.open(encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row.get("german")]
    translations = {
        Text(row["file"], row["context"], row["english"]): row["german"] for row in rows
    }
    faults = [
        f"{text.file}: {text.english!r} has other fields than its German {german!r}"
        for text, german in translations.items()
        if fields(text.english) != fields(german)
    ]
    filled = set() if faults else _write(translations)
    if not faults:
        faults = [
            f"{text.file}: no open text {text.english!r}" for text in translations.keys() - filled
        ]
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{len(filled)} translations filled")
    return 1 if faults else 0


def fields(text: str) -> list[str]:
    """Return the ``{fields}`` of a template in alphabetical order."""
    return sorted(re.findall(r"\{[^{}]*\}", text))


def _write(translations: Mapping[Text, str]) -> set[Text]:
    """Write translations into the files; return the texts that were filled."""
    filled = set()
    for path in sorted(FOLDER.glob("*.ts")):
        root = ET.fromstring(path.read_text("utf-8"))  # noqa: S314 (of this repository)
        before = len(filled)
        for context in root.iter("context"):
            for message in context.iter("message"):
                text = Text(path.name, context.findtext("name", ""), message.findtext("source", ""))
                translation = message.find("translation")
                if translation is not None and translation.get("type") and text in translations:
                    translation.text = translations[text]
                    del translation.attrib["type"]
                    filled.add(text)
        if len(filled) > before:
            path.write_text(HEADER + ET.tostring(root, encoding="unicode") + "\n", "utf-8")
    return filled


def _git(*words: str) -> str:
    process = subprocess.run(
        ["git", "-C", str(ROOT), *words],  # noqa: S607 (found in the PATH)
        capture_output=True,
        check=True,
        encoding="utf-8",
    )
    return process.stdout


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
