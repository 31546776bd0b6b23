from .diagnosis_job import (
    BackgroundDiagnosis as BackgroundDiagnosis,
)
from .record_selection import (
    RecordSelection as RecordSelection,
)
from .robot_choice import (
    RobotChoice as RobotChoice,
)
from .start_section import (
    StartSection as StartSection,
)
