"""Pages of the documentation in the window: carried, shown offline, reached from each panel."""

import pytest
from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QWidget

from rotemina.app.panel import Panel
from rotemina.app.shell import help_pages
from rotemina.app.shell.help_page import HelpPage
from rotemina.app.shell.panel_host import GROUP
from rotemina.drivers.registry import discover

PANELS = ("plots", "microscope", "faults")


@pytest.fixture
def browser_of(qtbot):
    """Make a help window beside a bare one."""
    windows = []

    def make():
        parent = QWidget()
        windows.append(parent)
        qtbot.addWidget(parent)
        return HelpPage(parent)

    return make


@pytest.fixture
def opened(monkeypatch):
    """What the web browser was told to open."""
    addresses = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: addresses.append(url.toString()))
    return addresses


def test_every_panel_names_a_page_and_a_section_that_the_program_carries(browser_of):
    shown = browser_of()
    found = discover(GROUP, Panel).found
    assert len(found) >= 18
    for name, kind in found.items():
        page = help_pages.page(kind.help_page)
        text = page.text()
        assert text is not None, f"{name}: {kind.help_page!r}"
        assert not page.anchor or page.anchor in help_pages.anchors(text), kind.help_page
        shown.open_page(kind.help_page)
        heading = shown.browser.textCursor().block().text()
        assert shown.page == page
        assert help_pages.slug(heading) == page.anchor or not page.anchor, kind.help_page


def test_every_page_is_carried_and_its_links_lead_to_pages_or_say_why_not(browser_of, opened):
    shown = browser_of()
    shown.open_page("index.md")
    assert "physics.md" in help_pages.contents()
    shown.browser.anchorClicked.emit(QUrl("motion.md#limits"))
    assert (shown.page.name, shown.browser.textCursor().block().text()) == (
        "motion.md#limits",
        "Limits",
    )
    shown.browser.anchorClicked.emit(QUrl("#stop"))
    assert shown.page.name == "motion.md#stop"
    shown.browser.anchorClicked.emit(QUrl("decisions/layers.md"))
    shown.browser.anchorClicked.emit(QUrl("../safety.md"))
    assert shown.page.name == "safety.md"
    for link in ("../README.md", "api/panel.md", "../pyproject.toml", "file:///etc/hosts.md"):
        shown.browser.anchorClicked.emit(QUrl(link))
        assert shown.page.name == "safety.md"
        assert link in shown.told.text()
    for _ in range(3):
        shown.back.click()
    assert shown.page.name == "motion.md#limits"
    assert opened == []
    shown.browser.anchorClicked.emit(QUrl("https://example.org/"))
    assert opened == ["https://example.org/"]
    shown.open_page("nowhere.md")
    assert "No such page" in shown.browser.toPlainText()


def test_nothing_from_elsewhere_is_loaded_or_run(browser_of, tmp_path):
    shown, picture = browser_of(), tmp_path / "picture.png"
    picture.write_bytes(b"x")
    load = shown.browser.loadResource
    for address in ("https://example.org/a.png", picture.as_uri(), f"../../../..{picture}"):
        held = load(2, QUrl(address))
        assert held.isEmpty() if hasattr(held, "isEmpty") else held.isNull()
    shown.show()
    assert load(2, QUrl("screenshots/gap-1280x800-dark.png")).width() > 100
    shown.browser.show_page(help_pages.page("index.md"), "# A\n\n<script>alert(1)</script>\n\nB")
    assert "alert(1)" in shown.browser.toPlainText()  # shown as text


def test_code_and_comments():
    page = help_pages.page("first-steps.md")
    assert "<!--" in page.read_bytes().decode()
    assert "<!--" not in page.text()
    assert "```\npip install .\nrotemina\n```" in page.text()
    effects = help_pages.page("effects.md").text()
    assert effects.count("```") % 2 == 0


def test_the_question_mark_of_docks_and_tabs_and_the_key(qtbot, window):
    page = window.help_page
    for name, dock in window.docks.items():
        (button,) = (each for each in dock.findChildren(QWidget, "help") if each.parent() is dock)
        button.click()
        assert page.isVisible()
        assert page.page.name == window.panels[name].help_page
    tabs = window.central_tabs
    for index in range(tabs.count()):
        tabs.setCurrentIndex(index)
        tabs.cornerWidget().click()
        assert page.page.name == tabs.widget(index).widget().help_page
    page.hide()
    dock = window.docks["faults"]
    dock.raise_()
    window.activateWindow()
    window.panels["faults"].injection.start.setFocus()
    qtbot.waitUntil(lambda: window.focusWidget() is window.panels["faults"].injection.start)
    window.help_here()
    assert page.page.name == "faults.md"
    dock.setFloating(True)
    button = dock.findChild(QWidget, "help")
    assert dock.rect().contains(button.geometry())
    assert not button.geometry().intersects(dock.widget().geometry())
