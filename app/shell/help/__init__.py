"""Help in the window: documentation pages, shortcuts, first steps, and the About box.

``help_pages`` finds pages and resolves their links, and ``help_page`` shows one without a network.
The window opens them; a panel only names its page.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
