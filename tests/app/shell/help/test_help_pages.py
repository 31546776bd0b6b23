"""The help pages are part of the program, shown offline and opened from every panel."""

import pytest
from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QWidget

from rotemina.app.panel import Panel
from rotemina.app.shell.help import HelpDialog, help_pages
from rotemina.app.shell.panels.panel_host import ENTRY_POINT_GROUP
from rotemina.drivers.contract import discover_plugins

PANELS = ("plots", "microscope", "faults")


@pytest.fixture
def make_help_dialog(qtbot):
    """Make a help window with an empty parent."""
    parents = []

    def make():
        parent = QWidget()
        parents.append(parent)
        qtbot.addWidget(parent)
        return HelpDialog(parent)

    return make


@pytest.fixture
def opened_addresses(monkeypatch):
    """The addresses opened in the web browser."""
    addresses = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: addresses.append(url.toString()))
    return addresses


def test_the_help_page_and_section_of_every_panel_exist(make_help_dialog):
    dialog = make_help_dialog()
    panels = discover_plugins(ENTRY_POINT_GROUP, Panel).plugins
    assert len(panels) >= 18
    for name, panel_class in panels.items():
        page = help_pages.parse_page_name(panel_class.help_page)
        text = page.text()
        assert text is not None, f"{name}: {panel_class.help_page!r}"
        assert not page.anchor or page.anchor in help_pages.find_anchors(text), (
            panel_class.help_page
        )
        dialog.open_page(panel_class.help_page)
        heading = dialog.browser.textCursor().block().text()
        assert dialog.page == page
        assert help_pages.make_slug(heading) == page.anchor or not page.anchor, (
            panel_class.help_page
        )


def test_links_open_a_page_or_say_why_not(make_help_dialog, opened_addresses):
    dialog = make_help_dialog()
    dialog.open_page("index.md")
    assert "physics.md" in help_pages.make_contents()
    dialog.browser.anchorClicked.emit(QUrl("motion.md#limits"))
    assert (dialog.page.name, dialog.browser.textCursor().block().text()) == (
        "motion.md#limits",
        "Limits",
    )
    dialog.browser.anchorClicked.emit(QUrl("#stop"))
    assert dialog.page.name == "motion.md#stop"
    dialog.browser.anchorClicked.emit(QUrl("decisions/layers.md"))
    dialog.browser.anchorClicked.emit(QUrl("../safety.md"))
    assert dialog.page.name == "safety.md"
    for link in ("../README.md", "api/panel.md", "../pyproject.toml", "file:///etc/hosts.md"):
        dialog.browser.anchorClicked.emit(QUrl(link))
        assert dialog.page.name == "safety.md"
        assert link in dialog.link_message.text()
    for _ in range(3):
        dialog.back.click()
    assert dialog.page.name == "motion.md#limits"
    assert opened_addresses == []
    dialog.browser.anchorClicked.emit(QUrl("https://example.org/"))
    assert opened_addresses == ["https://example.org/"]
    dialog.open_page("nowhere.md")
    assert "No such page" in dialog.browser.toPlainText()


def test_no_external_resource_is_loaded_and_no_script_runs(make_help_dialog, tmp_path):
    dialog, picture = make_help_dialog(), tmp_path / "picture.png"
    picture.write_bytes(b"x")
    load = dialog.browser.loadResource
    for address in ("https://example.org/a.png", picture.as_uri(), f"../../../..{picture}"):
        resource = load(2, QUrl(address))
        assert resource.isEmpty() if hasattr(resource, "isEmpty") else resource.isNull()
    dialog.show()
    assert load(2, QUrl("screenshots/gap-1280x800-dark.png")).width() > 100
    dialog.browser.show_page(
        help_pages.parse_page_name("index.md"), "# A\n\n<script>alert(1)</script>\n\nB"
    )
    assert "alert(1)" in dialog.browser.toPlainText()  # shown as text


def test_comments_are_removed_and_code_blocks_kept():
    page = help_pages.parse_page_name("first-steps.md")
    assert "<!--" in page.read_bytes().decode()
    assert "<!--" not in page.text()
    assert "```\npip install .\nrotemina\n```" in page.text()
    effects = help_pages.parse_page_name("effects.md").text()
    assert effects.count("```") % 2 == 0


def test_help_opens_from_docks_tabs_and_the_keyboard(qtbot, window):
    help_page = window.help_page
    for name, dock in window.docks.items():
        (button,) = (
            widget for widget in dock.findChildren(QWidget, "help") if widget.parent() is dock
        )
        button.click()
        assert help_page.isVisible()
        assert help_page.page.name == window.panels[name].help_page
    tabs = window.central_tabs
    for index in range(tabs.count()):
        tabs.setCurrentIndex(index)
        tabs.cornerWidget().click()
        assert help_page.page.name == tabs.widget(index).widget().help_page
    help_page.hide()
    dock = window.docks["faults"]
    dock.raise_()
    window.activateWindow()
    window.panels["faults"].injection.start_button.setFocus()
    qtbot.waitUntil(lambda: window.focusWidget() is window.panels["faults"].injection.start_button)
    window.show_panel_help()
    assert help_page.page.name == "faults.md"
    dock.setFloating(True)
    button = dock.findChild(QWidget, "help")
    assert dock.rect().contains(button.geometry())
    assert not button.geometry().intersects(dock.widget().geometry())
