from .cautions import (
    RecordCaution as RecordCaution,
    collect_remarks as collect_remarks,
)
from .record_checks import (
    check_records as check_records,
)
from .time_leaps import (
    split_at_leaps as split_at_leaps,
)
