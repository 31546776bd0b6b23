"""The window that shows pages of the documentation; it needs no network and runs no scripts."""

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

from rotemina.app.shell import help_pages
from rotemina.app.shell.background import Background
from rotemina.app.shell.help_pages import Page
from rotemina.app.shell.language import translate
from rotemina.app.widgets.controls import allow

logger = logging.getLogger(__name__)

MOST_BACK = 100  # pages that Back goes over
_MARGIN = 14.0  # px around text
_WEB = ("http", "https")
_FEATURES = QTextDocument.MarkdownFeature


class HelpBrowser(QTextBrowser):
    """Shows Markdown; nothing is read but files that a page's package carries."""

    def __init__(self) -> None:
        super().__init__()
        self.setOpenLinks(False)  # the page decides where a link leads
        self.setAccessibleName(translate("shell", "Page of the documentation"))
        self.page = Page(help_pages.PACKAGE, help_pages.CONTENTS)
        self._background = Background(self)

    def show_page(self, page: Page, text: str) -> None:
        """Show a page from its section on."""
        self.page = page
        document = QTextDocument(self)
        document.setUndoRedoEnabled(False)
        document.setDefaultFont(self.font())
        features = _FEATURES.MarkdownDialectGitHub | _FEATURES.MarkdownNoHTML
        document.setMarkdown(text, features)
        self._space(document)
        # Only now: a document that is shown is laid out again after each of these steps.
        self.setDocument(document)
        self.go_to(page.anchor)

    def go_to(self, anchor: str) -> None:
        """Bring a section to the top, or the beginning if there is no such section."""
        block = self._heading(anchor)
        self.setTextCursor(QTextCursor(block))
        self.verticalScrollBar().setValue(0)
        if block != self.document().begin():
            top = self.document().documentLayout().blockBoundingRect(block).top()
            self.verticalScrollBar().setValue(round(top))

    def loadResource(self, kind: int, name: QUrl | str) -> object:  # noqa: N802 (Qt's name)
        """Return a picture that the page's package carries; anything else is not fetched."""
        address = QUrl(name)
        if not address.isRelative():
            return QByteArray()
        data = self.page.beside(address.path()).read_bytes()
        size = _size_of(data or b"")
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

        # Its place is laid out at once; to read a large picture takes long.
        self._background.run(
            f"picture {address.path()}", lambda: _picture(data, size), show, logger.warning
        )
        place = QImage(size, QImage.Format.Format_ARGB32_Premultiplied)
        place.fill(Qt.GlobalColor.transparent)
        return place

    def _heading(self, anchor: str) -> QTextBlock:
        block = self.document().begin()
        while anchor and block.isValid():
            if block.blockFormat().headingLevel() and help_pages.slug(block.text()) == anchor:
                return block
            block = block.next()
        return self.document().begin()

    def _space(self, document: QTextDocument) -> None:
        """Give paragraphs and code room, which Markdown leaves to the one who shows it."""
        document.setDocumentMargin(_MARGIN)
        tint = self.palette().color(QPalette.ColorRole.AlternateBase)
        block = document.begin()
        while block.isValid():
            cursor = QTextCursor(block)
            look = block.blockFormat()
            if look.hasProperty(QTextFormat.Property.BlockCodeFence):
                look.setBackground(tint)
                look.setLeftMargin(_MARGIN)
            elif cursor.currentTable() is None and block.textList() is None:
                look.setTopMargin(_MARGIN if look.headingLevel() else _MARGIN / 2)
                look.setBottomMargin(_MARGIN / 2)
            cursor.setBlockFormat(look)
            block = block.next()


def _size_of(data: bytes) -> QSize:
    """Return the size of a picture, px; nothing but its head is read."""
    buffer = QBuffer()
    buffer.setData(data)
    return QImageReader(buffer).size()


def _picture(data: bytes, size: QSize) -> QImage:
    picture = QImage()
    picture.loadFromData(data)
    if picture.size() == size:
        return picture
    return picture.scaled(size, mode=Qt.TransformationMode.SmoothTransformation)


class HelpPage(QDialog):
    """A window of its own beside the operator's: a page, and the way back and to the others."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(translate("shell", "Help"))
        self.resize(820, 640)
        self.browser = HelpBrowser()
        self.browser.anchorClicked.connect(self._follow)
        self.back = self._button(translate("shell", "Back"), QKeySequence("Alt+Left"), self.go_back)
        self.contents = self._button(
            translate("shell", "Contents"), QKeySequence("Alt+Home"), self._open_contents
        )
        allow(self.contents, None, translate("shell", "All pages (Alt+Home)"))
        self.told = QLabel()
        self.told.setProperty("quiet", True)
        self.told.setWordWrap(True)
        self._gone: list[Page] = []
        row = QHBoxLayout()
        row.addWidget(self.back)
        row.addWidget(self.contents)
        row.addWidget(self.told, 1)
        column = QVBoxLayout(self)
        column.addLayout(row)
        column.addWidget(self.browser, 1)
        self._allow()

    @property
    def page(self) -> Page:
        """What is shown."""
        return self.browser.page

    def open_page(self, name: str) -> None:
        """Show a page by its name and bring the window to the front."""
        if self.isVisible():
            self._gone = [*self._gone, self.page][-MOST_BACK:]
        else:
            self._gone = []
            self.show()  # first, so that the page is laid out at its width
        self._show(help_pages.page(name))
        self.raise_()
        self.activateWindow()

    def restyle(self) -> None:
        """Show the page in the colours of now."""
        if self.isVisible():
            self._show(self.page)

    def go_back(self) -> None:
        """Show the page before this one."""
        if self._gone:
            self._show(self._gone.pop())

    def _follow(self, address: QUrl) -> None:
        if address.scheme() in _WEB:
            QDesktopServices.openUrl(address)
            return
        target = self.page.beside(address.toString()) if address.isRelative() else None
        if target is None or not target.path.endswith(".md") or not target.exists:
            self.told.setText(
                translate(
                    "shell",
                    "The program does not contain {address}; see the folder docs of its source,"
                    " or the site that `make docs` builds.",
                ).format(address=address.toString())
            )
            return
        self._gone = [*self._gone, self.page][-MOST_BACK:]
        self._show(target)

    def _show(self, page: Page) -> None:
        text = help_pages.contents() if page.name == help_pages.CONTENTS else page.text()
        if text is None:
            text = translate(
                "shell", "# No such page\n\nThe program has no page {name!r}. [All pages]"
            ).format(name=page.name)
            text += f"({help_pages.CONTENTS})"
            page = Page(help_pages.PACKAGE, page.path)
        self.told.clear()
        self.browser.show_page(page, text)
        self.setWindowTitle(
            translate("shell", "Help: {text}").format(text=self.browser.document().begin().text())
        )
        self._allow()

    def _open_contents(self) -> None:
        self.open_page(help_pages.CONTENTS)

    def _allow(self) -> None:
        none = None if self._gone else translate("shell", "there is no previous page")
        allow(self.back, none, translate("shell", "Previous page (Alt+Left)"))

    def _button(self, text: str, keys: QKeySequence, act: object) -> QPushButton:
        button = QPushButton(text)
        button.setAutoDefault(False)
        button.setShortcut(keys)
        button.clicked.connect(act)
        return button
