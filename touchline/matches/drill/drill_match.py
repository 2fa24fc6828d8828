"""The match of a drill: a scene at a seed's start, with a team that practises and opponents."""

from typing import Any

from schemas.config.match_config import MatchConfig, load_match
from schemas.config.scene import Scene, load_scene
from schemas.side import Side
from sim_host.staging.variation import varied


def drill_match(
    scene: str | Scene, seed: int, brains: dict[Side, str], settings: dict[str, Any] | None = None
) -> MatchConfig:
    """The match of a seed; `settings` are further keys of a match file, with dots.

    Raises:
        TouchlineError: the scene or a setting is invalid.
    """
    start = varied(load_scene(scene) if isinstance(scene, str) else scene, seed)
    teams = {f"teams.{side}": {"brain": brain, "name": brain.partition(":")[2]} for side, brain in brains.items()}
    content: dict[str, Any] = {"scene": start.model_dump(mode="json"), "seed": seed, "duration": 3600.0}
    return load_match(None, content | teams | (settings or {}))
