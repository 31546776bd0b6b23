from .camera import (
    SceneCamera as SceneCamera,
)
from .projected_picture import (
    ProjectedPicture as ProjectedPicture,
    ProjectedSolid as ProjectedSolid,
)
from .robot_scene import (
    GhostPositions as GhostPositions,
    RobotGhost as RobotGhost,
    RobotScene as RobotScene,
    SceneColours as SceneColours,
)
from .scale_notes import (
    SceneTexts as SceneTexts,
)
from .scene import (
    SceneCommandStore as SceneCommandStore,
)
from .server import (
    ViewServer as ViewServer,
)
from .views import (
    SceneViewpoint as SceneViewpoint,
)
