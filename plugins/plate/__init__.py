"""The holding plate in 3-D.

Stress, deformation and modes over the range of motion.
"""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("plate")
