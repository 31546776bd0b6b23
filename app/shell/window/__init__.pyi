from .layouts import (
    BUILT_IN as BUILT_IN,
    DIAGNOSE as DIAGNOSE,
    OPERATE as OPERATE,
)
from .main_window import (
    MainWindow as MainWindow,
)
from .model_chip import (
    describe_model as describe_model,
)
