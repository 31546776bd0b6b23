from .free_places import (
    find_header_bottom as find_header_bottom,
)
from .notices import (
    NoticeBoard as NoticeBoard,
)
