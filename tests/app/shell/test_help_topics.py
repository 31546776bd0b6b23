"""Messages lead to the page that explains them."""

import ast
import logging
from pathlib import Path

import pytest

from rotemina.app.motion.state import Faulted
from rotemina.app.shell import help_pages
from rotemina.app.shell.help_topics import PAGES, explained, page_by_name, page_for, page_of
from rotemina.app.shell.workbench import Level
from rotemina.drivers.errors import LimitError
from rotemina.sim.records.record import RecordError

ROOT = Path(__file__).parents[3]
LONG_MS = 30_000
PANELS = ("faults",)
#: Messages that know their page already.
CARRIED = {"reason", "message"}


@pytest.mark.parametrize("name", sorted(set(PAGES.values())))
def test_pages_of_the_table_are_there(name):
    page = help_pages.page(name)
    text = page.text()
    assert text is not None
    assert not page.anchor or page.anchor in help_pages.anchors(text)


def test_every_error_of_the_program_has_a_page():
    lost = [
        f"{layer}.{node.name}"
        for layer in ("app", "drivers", "sim")
        for path in (ROOT / layer).rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.ClassDef)
        and node.name.endswith("Error")
        and not page_by_name(f"{module_of(path)}.{node.name}")
    ]
    assert sorted(lost) == ["sim.InputError", "sim.ToldError"]  # the roots of the others


def test_every_warning_of_window_and_panels_says_what_it_is_about():
    silent = [
        f"{path}:{call.lineno}"
        for folder in ("app/shell", "app/widgets", "plugins")
        for path in sorted((ROOT / folder).rglob("*.py"))
        for call in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(call, ast.Call) and is_warning(call) and not says_about(call)
    ]
    assert silent == []


def test_the_nearest_class_counts():
    class OfAPluginError(LimitError):
        """A driver's by others."""

    assert page_for(OfAPluginError("no")) == PAGES["rotemina.drivers.errors.LimitError"]
    assert page_for(Faulted("hot")) == PAGES["rotemina.app.motion.state.Faulted"]
    assert page_for("safety.md") == "safety.md"
    assert page_for(KeyError("x")) == page_for(None) == page_of("text") == ""
    message = explained(RecordError("row 3"))
    assert (message, page_of(message)) == ("row 3", PAGES["rotemina.sim.records"])


def test_a_notice_opens_its_page(qtbot, window, tmp_path):
    bench, shown = window.workbench, window.help_page
    bench.go_to({"x": 99.0})
    assert opened(window) == "motion.md#limits"
    broken = tmp_path / "broken.csv"
    broken.write_text("t [s],x.cmd [m]\n0,1\noops,2\n", "utf-8")
    bench.open_record(broken)
    qtbot.waitUntil(lambda: "broken.csv" in window.notices.notices()[0].text, timeout=LONG_MS)
    assert opened(window).startswith("file-formats.md")
    bench.notify(Level.WARNING, "from a panel", about=window.panels["faults"].injection)
    assert opened(window) == "faults.md"
    shown.hide()
    bench.notify(Level.INFO, "nobody explains this")
    assert not hasattr(window.notices.notices()[0], "help")


def test_a_row_of_the_log_opens_its_page(window):
    page = window.log_page
    window.show_log()
    window.workbench.notify(Level.GOOD, "all is well")
    logging.getLogger("rotemina.drivers.registry").warning("plugin x is left out")
    page.refresh()
    assert not page.help.isEnabled()
    page.words.setText("left out")
    page.table.selectRow(0)
    page.help.click()
    assert window.help_page.page.name == "plugins.md#what-a-bad-plugin-can-do"
    page.words.setText("all is well")
    page.table.selectRow(0)
    assert not page.help.isEnabled()
    assert "no page" in page.help.toolTip()
    page.close()


def opened(window):
    window.notices.notices()[0].help.click()
    assert window.help_page.isVisible()
    return window.help_page.page.name


def module_of(path):
    return "rotemina." + ".".join(path.relative_to(ROOT).with_suffix("").parts)


def is_warning(call):
    name = getattr(call.func, "attr", "")
    level = ast.unparse(call.args[0]) if call.args else ""
    return name in ("notify", "_notify") and ("ERROR" in level or "WARNING" in level)


def says_about(call):
    carried = isinstance(call.args[1], ast.Name) and call.args[1].id in CARRIED
    return carried or any(word.arg == "about" for word in call.keywords)
