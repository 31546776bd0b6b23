"""The help window, which shows documentation pages; it needs no network and runs no scripts."""

import logging

from PySide6.QtCore import QBuffer, QByteArray, QSize, Qt, QUrl
from PySide6.QtGui import (
    QDesktopServices,
    QImage,
    QImageReader,
    QKeySequence,
    QPalette,
    QTextBlock,
    QTextCursor,
    QTextDocument,
    QTextFormat,
)
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.language import translate
from rotemina.app.shell.help import help_pages
from rotemina.app.shell.help.help_pages import DocumentationPage
from rotemina.app.widgets.controls import enable_unless
from rotemina.app.workbench import BackgroundWorker

logger = logging.getLogger(__name__)

MAX_HISTORY_PAGES = 100
_MARGIN_PX = 14.0
_WEB_SCHEMES = ("http", "https")
_MARKDOWN_FEATURE = QTextDocument.MarkdownFeature


class HelpBrowser(QTextBrowser):
    """Viewer of Markdown pages; it only reads files of the page's own package."""

    def __init__(self) -> None:
        super().__init__()
        # The help window handles links itself.
        self.setOpenLinks(False)
        self.setAccessibleName(translate("shell", "Page of the documentation"))
        self.page = DocumentationPage(help_pages.DOCS_PACKAGE, help_pages.CONTENTS_PAGE)
        self._background = BackgroundWorker(self)

    def show_page(self, page: DocumentationPage, text: str) -> None:
        """Show a page, starting at its section."""
        self.page = page
        document = QTextDocument(self)
        document.setUndoRedoEnabled(False)
        document.setDefaultFont(self.font())
        features = _MARKDOWN_FEATURE.MarkdownDialectGitHub | _MARKDOWN_FEATURE.MarkdownNoHTML
        document.setMarkdown(text, features)
        self._set_spacing(document)
        # The document is set last, because a visible document is laid out again after each change.
        self.setDocument(document)
        self.go_to_section(page.anchor)

    def go_to_section(self, anchor: str) -> None:
        """Scroll to a section, or to the beginning if there is no such section."""
        block = self._find_heading(anchor)
        self.setTextCursor(QTextCursor(block))
        self.verticalScrollBar().setValue(0)
        if block != self.document().begin():
            top = self.document().documentLayout().blockBoundingRect(block).top()
            self.verticalScrollBar().setValue(round(top))

    def loadResource(self, kind: int, name: QUrl | str) -> object:  # noqa: N802 (Qt's name)
        """Return a picture of the page's package; nothing else is loaded."""
        address = QUrl(name)
        if not address.isRelative():
            return QByteArray()
        data = self.page.resolve_link(address.path()).read_bytes()
        size = _read_picture_size(data or b"")
        width = self.viewport().width() - 40
        if size.width() > width > 0:
            size.scale(width, size.height(), Qt.AspectRatioMode.KeepAspectRatio)
        if data is None or size.isEmpty():
            return QImage()
        document = self.document()

        def show(picture: QImage) -> None:
            if self.document() is document:
                document.addResource(kind, address, picture)
                self.viewport().update()

        # Reading a large picture is slow, so a placeholder of its size is laid out first.
        self._background.run(
            f"picture {address.path()}", lambda: _read_picture(data, size), show, logger.warning
        )
        placeholder = QImage(size, QImage.Format.Format_ARGB32_Premultiplied)
        placeholder.fill(Qt.GlobalColor.transparent)
        return placeholder

    def _find_heading(self, anchor: str) -> QTextBlock:
        block = self.document().begin()
        while anchor and block.isValid():
            if block.blockFormat().headingLevel() and help_pages.make_slug(block.text()) == anchor:
                return block
            block = block.next()
        return self.document().begin()

    def _set_spacing(self, document: QTextDocument) -> None:
        """Add space around paragraphs and code, which Markdown does not define."""
        document.setDocumentMargin(_MARGIN_PX)
        code_background = self.palette().color(QPalette.ColorRole.AlternateBase)
        block = document.begin()
        while block.isValid():
            cursor = QTextCursor(block)
            block_format = block.blockFormat()
            if block_format.hasProperty(QTextFormat.Property.BlockCodeFence):
                block_format.setBackground(code_background)
                block_format.setLeftMargin(_MARGIN_PX)
            elif cursor.currentTable() is None and block.textList() is None:
                block_format.setTopMargin(
                    _MARGIN_PX if block_format.headingLevel() else _MARGIN_PX / 2
                )
                block_format.setBottomMargin(_MARGIN_PX / 2)
            cursor.setBlockFormat(block_format)
            block = block.next()


def _read_picture_size(data: bytes) -> QSize:
    buffer = QBuffer()
    buffer.setData(data)
    return QImageReader(buffer).size()


def _read_picture(data: bytes, size: QSize) -> QImage:
    picture = QImage()
    picture.loadFromData(data)
    if picture.size() == size:
        return picture
    return picture.scaled(size, mode=Qt.TransformationMode.SmoothTransformation)


class HelpDialog(QDialog):
    """Separate window that shows one page, with buttons for the previous page and the contents."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(translate("shell", "Help"))
        self.resize(820, 640)
        self.browser = HelpBrowser()
        self.browser.anchorClicked.connect(self._follow_link)
        self.back = self._make_button(
            translate("shell", "Back"), QKeySequence("Alt+Left"), self.go_back
        )
        self.contents = self._make_button(
            translate("shell", "Contents"), QKeySequence("Alt+Home"), self._open_contents
        )
        enable_unless(self.contents, None, translate("shell", "All pages (Alt+Home)"))
        self.link_message = QLabel()
        self.link_message.setProperty("quiet", True)
        self.link_message.setWordWrap(True)
        self._history: list[DocumentationPage] = []
        row = QHBoxLayout()
        row.addWidget(self.back)
        row.addWidget(self.contents)
        row.addWidget(self.link_message, 1)
        column = QVBoxLayout(self)
        column.addLayout(row)
        column.addWidget(self.browser, 1)
        self._enable_back()

    @property
    def page(self) -> DocumentationPage:
        """The page that is shown."""
        return self.browser.page

    def open_page(self, name: str) -> None:
        """Show the page of this name and bring the window to the front."""
        if self.isVisible():
            self._history = [*self._history, self.page][-MAX_HISTORY_PAGES:]
        else:
            self._history = []
            # Shown first, so that the page is laid out at the right width.
            self.show()
        self._show_page(help_pages.parse_page_name(name))
        self.raise_()
        self.activateWindow()

    def restyle(self) -> None:
        """Show the page again, in the colours of the current theme."""
        if self.isVisible():
            self._show_page(self.page)

    def go_back(self) -> None:
        """Show the previous page."""
        if self._history:
            self._show_page(self._history.pop())

    def _follow_link(self, address: QUrl) -> None:
        if address.scheme() in _WEB_SCHEMES:
            QDesktopServices.openUrl(address)
            return
        target = self.page.resolve_link(address.toString()) if address.isRelative() else None
        if target is None or not target.path.endswith(".md") or not target.exists:
            self.link_message.setText(
                translate(
                    "shell",
                    "The program does not contain {address}; see the folder docs of its source,"
                    " or the site that `make docs` builds.",
                ).format(address=address.toString())
            )
            return
        self._history = [*self._history, self.page][-MAX_HISTORY_PAGES:]
        self._show_page(target)

    def _show_page(self, page: DocumentationPage) -> None:
        text = help_pages.make_contents() if page.name == help_pages.CONTENTS_PAGE else page.text()
        if text is None:
            text = translate(
                "shell", "# No such page\n\nThe program has no page {name!r}. [All pages]"
            ).format(name=page.name)
            text += f"({help_pages.CONTENTS_PAGE})"
            page = DocumentationPage(help_pages.DOCS_PACKAGE, page.path)
        self.link_message.clear()
        self.browser.show_page(page, text)
        self.setWindowTitle(
            translate("shell", "Help: {text}").format(text=self.browser.document().begin().text())
        )
        self._enable_back()

    def _open_contents(self) -> None:
        self.open_page(help_pages.CONTENTS_PAGE)

    def _enable_back(self) -> None:
        reason = None if self._history else translate("shell", "there is no previous page")
        enable_unless(self.back, reason, translate("shell", "Previous page (Alt+Left)"))

    def _make_button(self, text: str, keys: QKeySequence, on_click: object) -> QPushButton:
        button = QPushButton(text)
        button.setAutoDefault(False)
        button.setShortcut(keys)
        button.clicked.connect(on_click)
        return button
