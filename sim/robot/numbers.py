"""Number types of a robot file, as pydantic accepts them.

Numbers are strict (no text, no booleans, no NaN). Tables and lists may come as dict and list, the
only containers that TOML has.
"""

from typing import Annotated

from pydantic import ConfigDict, Field

FORBID_UNKNOWN = ConfigDict(extra="forbid")

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0)]
NotNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0)]
Count = Annotated[int, Field(strict=True, ge=1)]
Switch = Annotated[bool, Field(strict=True)]
# Far beyond any machine, but small enough that squares do not overflow.
Bound = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-1e6, le=1e6)]
Range = tuple[Bound, Bound]
