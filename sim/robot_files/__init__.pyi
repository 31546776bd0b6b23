from .consistency import (
    find_problem as find_problem,
)
from .reading import (
    CONVENTIONAL_UNITS as CONVENTIONAL_UNITS,
    list_nominal_robots as list_nominal_robots,
    list_shipped_robots as list_shipped_robots,
    load_robot as load_robot,
    parse_robot as parse_robot,
    read_robot_file as read_robot_file,
)
from .schema_errors import (
    describe_bound as describe_bound,
    describe_error as describe_error,
    describe_first_error as describe_first_error,
    suggest_keys as suggest_keys,
)
from .writing import (
    format_robot as format_robot,
    sort_by_axis as sort_by_axis,
    with_effects as with_effects,
    write_robot as write_robot,
)
