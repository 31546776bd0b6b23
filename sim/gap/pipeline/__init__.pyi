from . import diagnosis_pipeline as diagnosis_pipeline
from .diagnosis_pipeline import (
    diagnose as diagnose,
)
