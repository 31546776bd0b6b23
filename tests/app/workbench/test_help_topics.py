"""Messages lead to the page that explains them."""

import ast
import logging
import re
from pathlib import Path

from rotemina.app.motion.state import FaultRaised
from rotemina.app.shell.help import help_pages
from rotemina.app.workbench import Level, find_help_page, find_module_page, get_message_page
from rotemina.app.workbench.help_topics import PAGES_BY_NAME, explain_error
from rotemina.drivers.contract import LimitError
from rotemina.sim.errors import RecordError

ROOT = Path(__file__).parents[3]
LONG_MS = 30_000
PANELS = ("faults",)
#: Variables whose message already knows its page.
VARIABLES_WITH_PAGE = {"reason", "message"}


def test_pages_of_the_table_exist():
    for name in set(PAGES_BY_NAME.values()):
        page = help_pages.parse_page_name(name)
        text = page.text()
        assert text is not None, name
        assert not page.anchor or page.anchor in help_pages.find_anchors(text), name


def test_every_error_of_the_program_has_a_page():
    without_page = [
        f"{layer}.{name}"
        for layer in ("app", "drivers", "sim")
        for path in (ROOT / layer).rglob("*.py")
        for name in re.findall(r"^ *class (\w+Error)\b", path.read_text("utf-8"), re.MULTILINE)
        if not find_module_page(f"{get_module_name(path)}.{name}")
    ]
    assert sorted(without_page) == ["sim.InputError", "sim.MessageError"]  # the roots of the others


def test_every_warning_of_window_and_panels_names_its_topic():
    without_topic = [
        f"{path}:{call.lineno}"
        for folder in ("app/language", "app/workbench", "app/shell", "app/widgets", "plugins")
        for path in sorted((ROOT / folder).rglob("*.py"))
        if "notify(" in (text := path.read_text("utf-8"))
        for call in ast.walk(ast.parse(text))
        if isinstance(call, ast.Call) and is_warning(call) and not has_topic(call)
    ]
    assert without_topic == []


def test_the_nearest_base_class_determines_the_page():
    class PluginError(LimitError):
        """An error of a third-party driver."""

    assert (
        find_help_page(PluginError("no"))
        == PAGES_BY_NAME["rotemina.drivers.contract.errors.LimitError"]
    )
    assert (
        find_help_page(FaultRaised("hot"))
        == PAGES_BY_NAME["rotemina.app.motion.state.state.FaultRaised"]
    )
    assert find_help_page("safety.md") == "safety.md"
    assert find_help_page(KeyError("x")) == find_help_page(None) == get_message_page("text") == ""
    message = explain_error(RecordError("row 3"))
    assert (message, get_message_page(message)) == (
        "row 3",
        PAGES_BY_NAME["rotemina.sim.errors.errors.RecordError"],
    )


def test_a_notice_and_a_row_of_the_log_open_their_page(qtbot, window, tmp_path):
    bench, help_page = window.workbench, window.help_page
    bench.go_to({"x": 99.0})
    assert open_notice_page(window) == "motion.md#limits"
    broken = tmp_path / "broken.csv"
    broken.write_text("t [s],x.cmd [m]\n0,1\noops,2\n", "utf-8")
    bench.records.open_record(broken)
    qtbot.waitUntil(lambda: "broken.csv" in window.notices.notices()[0].text, timeout=LONG_MS)
    assert open_notice_page(window).startswith("file-formats.md")
    bench.notify(Level.WARNING, "from a panel", about=window.panels["faults"].injection)
    assert open_notice_page(window) == "faults.md"
    help_page.hide()
    bench.notify(Level.INFO, "nobody explains this")
    assert not hasattr(window.notices.notices()[0], "help")
    check_log_rows(qtbot, window)


def check_log_rows(qtbot, window):
    page = window.log_page
    window.show_log()
    logging.getLogger("rotemina.drivers.contract.registry").warning("plugin x is left out")
    page.refresh()
    assert not page.help.isEnabled()
    qtbot.keyClicks(page.words, "left out")  # keys without Shift, which an earlier test may hold
    page.table.selectRow(0)
    page.help.click()
    assert window.help_page.page.name == "plugins.md#what-a-bad-plugin-can-do"
    page.words.setText("nobody explains this")
    page.table.selectRow(0)
    assert not page.help.isEnabled()
    assert "no help page" in page.help.toolTip()
    page.close()


def open_notice_page(window):
    window.notices.notices()[0].help.click()
    assert window.help_page.isVisible()
    return window.help_page.page.name


def get_module_name(path):
    return "rotemina." + ".".join(path.relative_to(ROOT).with_suffix("").parts)


def is_warning(call):
    name = getattr(call.func, "attr", "")
    level = ast.unparse(call.args[0]) if call.args else ""
    return name in ("notify", "_notify") and ("ERROR" in level or "WARNING" in level)


def has_topic(call):
    knows_page = isinstance(call.args[1], ast.Name) and call.args[1].id in VARIABLES_WITH_PAGE
    return knows_page or any(keyword.arg == "about" for keyword in call.keywords)
