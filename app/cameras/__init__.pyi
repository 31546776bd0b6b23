from .feed import (
    CameraFeed as CameraFeed,
    FeedState as FeedState,
    FeedView as FeedView,
)
from .frame_check import (
    FrameCheck as FrameCheck,
    PictureState as PictureState,
)
from .snapshot import (
    SnapshotMetadata as SnapshotMetadata,
    StackPage as StackPage,
    format_program_version as format_program_version,
    write_png as write_png,
    write_stack as write_stack,
    write_tiff as write_tiff,
)
from .video import (
    VideoRecorder as VideoRecorder,
    VideoStatus as VideoStatus,
)
