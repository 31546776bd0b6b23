"""The German texts are complete, current and consistent with the English templates."""

import ast
import builtins
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from string import Formatter

import PySide6
import pytest
from PySide6.QtCore import QTranslator

from rotemina.app.cli.terminal import HELP_CONTEXT as HELP
from rotemina.app.records.run_report import TEMPLATE_TEXTS as RUN_TEXTS
from rotemina.plugins.effects.words import iterate_translatable_texts
from rotemina.sim.gap.output.report_texts import PAGE_TEXTS as GAP_TEXTS

ROOT = Path(__file__).parents[3]
FOLDER = ROOT / "resources" / "languages"
WINDOW_FILES = (
    "app/language/*.py",
    "app/workbench/*.py",
    "app/shell/**/*.py",
    "app/widgets/**/*.py",
    "plugins/*/**/*.py",
)
UPDATE = "; run `make languages`, and translate what it has added to resources/languages/de"
# As `make languages` has them.
OPTIONS = (
    *("-silent", "-tr-function-alias", "QT_TRANSLATE_NOOP+=marked,QT_TRANSLATE_NOOP+=message"),
    *("-disable-heuristic", "sametext", "-disable-heuristic", "similartext"),
    *("-locations", "none", "-no-obsolete", "-source-language", "en", "-target-language", "de"),
)
# Functions and methods that put a text on the screen, whatever their class.
DISPLAY_CALLS = (
    *("QLabel", "QPushButton", "QCheckBox", "QRadioButton", "QGroupBox", "QToolButton", "QAction"),
    *("setText", "setToolTip", "setStatusTip", "setWindowTitle", "setPlaceholderText", "setTitle"),
    *("setAccessibleName", "setAccessibleDescription", "setSpecialValueText", "setTabText"),
    *("addItem", "addAction", "addMenu", "addTab", "addRow", "setLabelText"),
    *("notify", "named", "allow", "plain_tip", "show_text", "setHorizontalHeaderLabels", "setHtml"),
)
# Not seen by an operator: self-tests, board firmware, stand-ins for a window.
PYTHON_ERRORS = {*dir(builtins), "ArgumentTypeError"}  # errors of Python itself
ENGLISH_ONLY = {
    "bench",
    "blind",
    "blind_second",
    "conformance",
    "firmware",
    "emulator.py",
    "exit_guard.py",
}
_WORDS = re.compile(r"[A-Za-z]{2,} [A-Za-z]{2,}|^[A-Z][a-z]{2,}|^[a-z]{4,}$")
_TAG = re.compile(r"</?[a-z][^<>]*>")
_MNEMONIC = re.compile(r"&(?=\w)")


def read_translations(path):
    """Return {(context, source): translation} of a file, None where it is unfinished."""
    translations = {}
    for context in ET.parse(path).iter("context"):  # noqa: S314 (a file of this repository)
        for message in context.iter("message"):
            element = message.find("translation")
            kind = element.get("type")
            assert kind in (None, "unfinished"), f"{path.name}: {kind} {message.findtext('source')}"
            text = None if kind else element.text
            translations[context.findtext("name"), message.findtext("source")] = text
    return translations


@pytest.fixture(scope="module")
def german():
    translations = {}
    for path in sorted((FOLDER / "de").glob("*.ts")):
        translations |= read_translations(path)
    return translations


def copy_with_contexts(path, folder):
    """Copy a panel's module and add the context to each text, as lupdate needs it."""
    context = path.relative_to(ROOT / "plugins").parts[0]
    text = path.read_text("utf-8")
    for short, full in (("tr", "translate"), ("mark", "marked")):
        text = re.sub(rf"(?<![\w.]){short}\(", f'{full}("{context}", ', text)
    copy = folder / path.relative_to(ROOT / "plugins")
    copy.parent.mkdir(parents=True, exist_ok=True)
    copy.write_text(text, "utf-8")
    return copy


def list_raised_texts(paths):
    """Return the texts of errors as `make languages` lists them."""
    command = [sys.executable, ROOT / ".ci" / "translations.py", "raised", *paths]
    return subprocess.run(command, capture_output=True, encoding="utf-8", check=True).stdout


def test_every_text_of_the_window_is_translated(german, tmp_path):
    window_files = {path for folder in WINDOW_FILES for path in ROOT.glob(folder)}
    engine_files = {*(ROOT / "sim").rglob("*.py"), *(ROOT / "drivers").rglob("*.py")}
    for folder in (
        *("cli", "motion", "operation", "microscope", "cameras", "calibration", "records"),
        *("scene", "plugin_kit", "panel", "settings", "system"),
    ):
        engine_files |= {*(ROOT / "app" / folder).rglob("*.py")}
    model = tmp_path / "catalogue.py"
    calls = (f'translate("effects", {text!r})' for text in iterate_translatable_texts())
    model.write_text("\n".join(calls), "utf-8")
    raised = tmp_path / "raised.py"
    raised.write_text(list_raised_texts(sorted({*window_files, *engine_files})), "utf-8")
    window_files = {
        copy_with_contexts(path, tmp_path) if path.is_relative_to(ROOT / "plugins") else path
        for path in window_files
    }
    sources = sorted({*window_files, *engine_files, model, raised})
    scanned = tmp_path / "found.ts"
    lupdate = Path(PySide6.__file__).parent / "lupdate"
    result = subprocess.run(
        [lupdate, *OPTIONS, *sources, "-ts", scanned], capture_output=True, text=True, check=True
    )
    assert result.stdout + result.stderr == ""
    current = read_translations(scanned)
    assert sorted(current.keys() - german.keys()) == [], f"not in a .ts file{UPDATE}"
    obsolete = {key for key in german if key[0] != HELP} - current.keys()
    assert sorted(obsolete) == [], f"not in the window any more{UPDATE}"
    assert [key for key, text in german.items() if not text] == [], f"not translated{UPDATE}"


def find_literals(call):
    """Yield the string literals that a call shows."""
    for argument in call.args:
        texts = argument.elts if isinstance(argument, ast.List | ast.Tuple) else [argument]
        for text in texts:
            if isinstance(text, ast.IfExp):
                texts += [text.body, text.orelse]
            parts = text.values if isinstance(text, ast.JoinedStr) else [text]
            for part in parts:
                if isinstance(part, ast.Constant) and isinstance(part.value, str):
                    yield part.value


def test_no_text_is_shown_untranslated():
    untranslated = []
    for path in (path for folder in WINDOW_FILES for path in ROOT.glob(folder)):
        for call in ast.walk(ast.parse(path.read_text("utf-8"))):
            if not isinstance(call, ast.Call):
                continue
            name = getattr(call.func, "attr", getattr(call.func, "id", ""))
            if name in DISPLAY_CALLS:
                texts = [
                    text for text in find_literals(call) if _WORDS.search(text) and "<" not in text
                ]
                untranslated += [
                    f"{path.relative_to(ROOT)}:{call.lineno}: {text!r}" for text in texts
                ]
    assert untranslated == []


def find_errors(path):
    """Yield (line, argument) of each error of this program created in a file."""
    text = path.read_text("utf-8")
    if "Error(" in text:
        for call in ast.walk(ast.parse(text)):
            if isinstance(call, ast.Call) and len(call.args) == 1:
                name = getattr(call.func, "attr", getattr(call.func, "id", ""))
                if name.endswith("Error") and name not in PYTHON_ERRORS:
                    yield call.lineno, call.args[0]


def test_the_text_of_every_error_is_a_literal_or_a_message():
    composed = []
    for folder in ("app", "drivers", "sim"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            if not ENGLISH_ONLY & {*path.relative_to(ROOT).parts}:
                for line, argument in find_errors(path):
                    if isinstance(argument, ast.JoinedStr | ast.BinOp):
                        composed.append(f"{path.relative_to(ROOT)}:{line}: {ast.unparse(argument)}")
    assert composed == []


@pytest.mark.parametrize(
    ("folder", "name", "texts"),
    [("sim/gap/output", "page.html", GAP_TEXTS), ("app/records", "run_report.html", RUN_TEXTS)],
)
def test_every_text_of_a_report_is_translated(folder, name, texts):
    frame = (ROOT / "sim/gap/output/frame.html").read_text("utf-8")
    page = (ROOT / folder / name).read_text("utf-8")
    translated = set(re.findall(r'"([^"]*)" \| t\b', frame + page))
    assert translated == set(texts)
    untranslated = re.findall(r">([^<>{}]*[A-Za-z]{2}[^<>{}]*)<", page)
    assert untranslated == []


def test_the_compiled_file_is_current(german):
    translator = QTranslator()
    assert translator.load(str(FOLDER / "de.qm"))
    outdated = {key: text for key, text in german.items() if translator.translate(*key) != text}
    assert outdated == {}, f"de.qm is older than its .ts files{UPDATE}"


def find_fields(text):
    return sorted(
        (name, spec, conversion) for _, name, spec, conversion in Formatter().parse(text) if name
    )


def test_templates_match_the_english_texts(german):
    mismatches = []
    for (context, source), text in german.items():
        text = text or ""
        pairs = {
            "fields": (find_fields(source), find_fields(text))
            if "{" in source + text
            else ("", ""),
            "tags": (sorted(_TAG.findall(source)), sorted(_TAG.findall(text))),
            "mnemonics": (len(_MNEMONIC.findall(source)), len(_MNEMONIC.findall(text))),
            "ends": (_get_ends(source), _get_ends(text)),
        }
        mismatches += [
            (context, source, aspect)
            for aspect, (source_part, text_part) in pairs.items()
            if source_part != text_part
        ]
    assert mismatches == []


def _get_ends(text):
    """Return the white space around a text, and whether it ends with an ellipsis."""
    return text[: len(text) - len(text.lstrip())], text[len(text.rstrip()) :], text[-1:] == "…"
