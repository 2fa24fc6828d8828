"""Changes of the scene of a running match."""

from enum import StrEnum
from typing import Annotated

from msgspec import Meta

from schemas.config.obstacle import ObstacleConfig
from schemas.config.roster import MAX_ROBOTS, Placement
from schemas.config.scene import Scene, SceneRobot
from schemas.wire.message import Message, Name, Source


class SceneOperation(StrEnum):
    """What to do with the scene of a running match."""

    LOAD = "load"
    PLACE = "place"
    ADD = "add"
    REMOVE = "remove"
    RESET = "reset"


class SceneRequest(Message):
    """A request to place, add or remove bodies, load a scene, or reset the world; all or nothing."""

    operation: SceneOperation
    """What to do."""
    load: str | None = None
    """For `load`: the name of a shipped scene."""
    scene: Scene | None = None
    """For `load`: the scene itself, in place of a name."""
    place: Annotated[list[Placement], Meta(max_length=100)] = []
    """For `place`: placements of robots or the ball."""
    robots: Annotated[list[SceneRobot], Meta(max_length=2 * MAX_ROBOTS)] = []
    """For `add`: robots that are added."""
    obstacles: Annotated[list[ObstacleConfig], Meta(max_length=100)] = []
    """For `add`: obstacles that are added."""
    remove: Annotated[list[Name], Meta(max_length=100)] = []
    """For `remove`: names of robots and obstacles."""
    to_match: bool = False
    """For `reset`: to the start of the match instead of the scene that was loaded last."""
    source: Source = "operator"
    """Name of the sender, for display."""


class SceneReply(Message):
    """The host's reply."""

    accepted: bool
    """The request was carried out."""
    reason: str = ""
    """Why it was refused; then nothing was changed."""
    episode: int
    """The episode from the next tick on; loading a scene and resetting begin a new one."""
