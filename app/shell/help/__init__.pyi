from . import key_help as key_help
from .about import (
    show_about as show_about,
)
from .first_steps import (
    FirstStepsCard as FirstStepsCard,
)
from .help_button import (
    DockHelpButton as DockHelpButton,
    TabHelpButton as TabHelpButton,
)
from .help_page import (
    HelpDialog as HelpDialog,
)
