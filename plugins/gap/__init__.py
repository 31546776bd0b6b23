"""Gap diagnosis and correction.

Where the gap is, which effects cause it, and how far it shrinks.
"""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("gap")
