"""The German of the window: complete, current, and true to the templates of the English texts."""

import ast
import builtins
import re
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path
from string import Formatter

import PySide6
import pytest
from PySide6.QtCore import QTranslator

from rotemina.app.cli.translated_help import CONTEXT as HELP
from rotemina.app.records.run_report import TEXTS as RUN_TEXTS
from rotemina.plugins.effects.words import catalogue
from rotemina.sim.gap.output.report.texts import TEXTS as GAP_TEXTS

ROOT = Path(__file__).parents[3]
FOLDER = ROOT / "resources" / "languages"
WINDOW = ("app/shell/*.py", "app/widgets/*.py", "plugins/*/*.py")
UPDATE = "; run `make languages`, and translate what it has added to resources/languages/de"
# As `make languages` has them.
OPTIONS = (
    *("-silent", "-tr-function-alias", "QT_TRANSLATE_NOOP+=marked,QT_TRANSLATE_NOOP+=message"),
    *("-disable-heuristic", "sametext", "-disable-heuristic", "similartext"),
    *("-locations", "none", "-no-obsolete", "-source-language", "en", "-target-language", "de"),
)
# What puts a text on the screen, whatever class it is of.
SHOWN_BY = (
    *("QLabel", "QPushButton", "QCheckBox", "QRadioButton", "QGroupBox", "QToolButton", "QAction"),
    *("setText", "setToolTip", "setStatusTip", "setWindowTitle", "setPlaceholderText", "setTitle"),
    *("setAccessibleName", "setAccessibleDescription", "setSpecialValueText", "setTabText"),
    *("addItem", "addAction", "addMenu", "addTab", "addRow", "setLabelText"),
    *("notify", "named", "allow", "plain_tip", "show_text", "setHorizontalHeaderLabels", "setHtml"),
)
# What no operator sees: self-tests, a board's own program, what stands in for a window.
FOREIGN = {*dir(builtins), "ArgumentTypeError"}  # errors of Python
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


def messages(path):
    """(context, source) -> translation of a file, None where it is none yet."""
    found = {}
    for context in ET.parse(path).iter("context"):  # noqa: S314 (a file of this repository)
        for message in context.iter("message"):
            made = message.find("translation")
            kind = made.get("type")
            assert kind in (None, "unfinished"), f"{path.name}: {kind} {message.findtext('source')}"
            text = None if kind else made.text
            found[context.findtext("name"), message.findtext("source")] = text
    return found


@pytest.fixture(scope="module")
def german():
    found = {}
    for path in sorted((FOLDER / "de").glob("*.ts")):
        found |= messages(path)
    return found


def with_contexts(path, folder):
    """A copy, in a folder, of a panel's module: each text with its context, as lupdate wants it."""
    context = path.parent.name
    text = path.read_text("utf-8")
    for short, full in (("tr", "translate"), ("mark", "marked")):
        text = re.sub(rf"(?<![\w.]){short}\(", f'{full}("{context}", ', text)
    copy = folder / context / path.name
    copy.parent.mkdir(exist_ok=True)
    copy.write_text(text, "utf-8")
    return copy


def test_every_text_of_the_window_is_translated(german, tmp_path):
    shown = {path for folder in WINDOW for path in ROOT.glob(folder)}
    shown = {
        with_contexts(path, tmp_path) if path.parts[-3] == "plugins" else path for path in shown
    }
    engine = {*(ROOT / "sim").rglob("*.py"), *(ROOT / "drivers").rglob("*.py")}
    engine |= {*(ROOT / "app").glob("*.py")}
    for folder in (
        *("cli", "motion", "microscope", "cameras", "calibration", "records"),
        *("scene", "plugin_kit"),
    ):
        engine |= {*(ROOT / "app" / folder).rglob("*.py")}
    model = tmp_path / "effects" / "catalogue.py"
    words = (f'translate("effects", {text!r})' for text in catalogue())
    model.write_text("\n".join(words), "utf-8")
    sources = sorted({*shown, *engine, model})
    found = tmp_path / "found.ts"
    program = Path(PySide6.__file__).parent / "lupdate"
    done = subprocess.run(
        [program, *OPTIONS, *sources, "-ts", found], capture_output=True, text=True, check=True
    )
    assert done.stdout + done.stderr == ""
    wanted = messages(found)
    assert sorted(wanted.keys() - german.keys()) == [], f"not in a .ts file{UPDATE}"
    gone = {key for key in german if key[0] != HELP} - wanted.keys()
    assert sorted(gone) == [], f"not in the window any more{UPDATE}"
    assert [key for key, text in german.items() if not text] == [], f"not translated{UPDATE}"


def literals(call):
    """Texts that a call shows as they are written."""
    for given in call.args:
        texts = given.elts if isinstance(given, ast.List | ast.Tuple) else [given]
        for text in texts:
            if isinstance(text, ast.IfExp):
                texts += [text.body, text.orelse]
            parts = text.values if isinstance(text, ast.JoinedStr) else [text]
            for part in parts:
                if isinstance(part, ast.Constant) and isinstance(part.value, str):
                    yield part.value


def test_no_text_is_shown_as_it_is_written():
    found = []
    for path in (path for folder in WINDOW for path in ROOT.glob(folder)):
        for call in ast.walk(ast.parse(path.read_text("utf-8"))):
            if not isinstance(call, ast.Call):
                continue
            name = getattr(call.func, "attr", getattr(call.func, "id", ""))
            if name in SHOWN_BY:
                texts = [text for text in literals(call) if _WORDS.search(text) and "<" not in text]
                found += [f"{path.relative_to(ROOT)}:{call.lineno}: {text!r}" for text in texts]
    assert found == []


def errors(path):
    """(line, what it is raised with) of each error of this program that is made in a file."""
    for call in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(call, ast.Call) and len(call.args) == 1:
            name = getattr(call.func, "attr", getattr(call.func, "id", ""))
            if name.endswith("Error") and name not in FOREIGN:
                yield call.lineno, call.args[0]


def test_no_error_says_what_has_no_translation():
    found = []
    for folder in ("app", "drivers", "sim"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            if not ENGLISH_ONLY & {*path.relative_to(ROOT).parts}:
                for line, told in errors(path):
                    text = isinstance(told, ast.Constant) and isinstance(told.value, str)
                    if (text and told.value) or isinstance(told, ast.JoinedStr):
                        found.append(f"{path.relative_to(ROOT)}:{line}: {ast.unparse(told)}")
    assert found == []


@pytest.mark.parametrize(
    ("folder", "name", "texts"),
    [
        ("sim/gap/output/report", "page.html", GAP_TEXTS),
        ("app/records", "run_report.html", RUN_TEXTS),
    ],
)
def test_a_report_says_nothing_that_has_no_translation(folder, name, texts):
    frame = (ROOT / "sim/gap/output/report/frame.html").read_text("utf-8")
    page = (ROOT / folder / name).read_text("utf-8")
    said = set(re.findall(r'"([^"]*)" \| t\b', frame + page))
    assert said == set(texts)
    bare = re.findall(r">([^<>{}]*[A-Za-z]{2}[^<>{}]*)<", page)
    assert bare == []


def test_the_file_that_the_window_reads_holds_them(german):
    translator = QTranslator()
    assert translator.load(str(FOLDER / "de.qm"))
    other = {key: text for key, text in german.items() if translator.translate(*key) != text}
    assert other == {}, f"de.qm is older than its .ts files{UPDATE}"


def fields(text):
    return sorted((name, spec, how) for _, name, spec, how in Formatter().parse(text) if name)


def test_templates_are_those_of_the_english_texts(german):
    wrong = []
    for (context, source), text in german.items():
        text = text or ""
        pairs = {
            "fields": (fields(source), fields(text)) if "{" in source + text else ("", ""),
            "tags": (sorted(_TAG.findall(source)), sorted(_TAG.findall(text))),
            "mnemonics": (len(_MNEMONIC.findall(source)), len(_MNEMONIC.findall(text))),
            "ends": (_ends(source), _ends(text)),
        }
        wrong += [(context, source, what) for what, (one, other) in pairs.items() if one != other]
    assert wrong == []


def _ends(text):
    """White space around a text, whether it goes on (…), and whether it has a colon."""
    return text[: len(text) - len(text.lstrip())], text[len(text.rstrip()) :], text[-1:] == "…"
