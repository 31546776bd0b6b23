"""The Job panel: the running jobs, their progress, and the buttons that pause and stop them.

Jobs are playbacks, penetrations and other runs that last. Their buttons are the ones of the panels
for trajectory and penetration.
"""

from rotemina.app.language import make_text_functions

tr, _ = make_text_functions("job")
