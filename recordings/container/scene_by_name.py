"""Embeds the scene in manifests whose config refers to the scene of the match by name."""

from typing import Any

from schemas.config.match_config import MatchConfig
from schemas.config.scene import load_scene
from schemas.errors import TouchlineError


def with_scene(manifest: dict[str, Any]) -> dict[str, Any]:
    """The fields of a manifest with the scene embedded, or with `missing_scene` if it cannot be read."""
    config = manifest.get("config")
    name = config.get("scene") if isinstance(config, dict) else None
    if not isinstance(config, dict) or not isinstance(name, str):
        return manifest
    try:
        whole = config | {"scene": load_scene(name).model_dump(mode="json")}
        MatchConfig.model_validate(whole)
    except (TouchlineError, ValueError):  # no such file, not a scene, or a scene without the robots of the match
        return manifest | {"config": _without_scene(config), "missing_scene": name}
    return manifest | {"config": whole}


def _without_scene(config: dict[str, Any]) -> dict[str, Any]:
    """The config without the parts that depend on its scene: `types` of a team refers to robots of the scene."""
    config = config | {"scene": None}
    teams = config.get("teams")
    if not isinstance(teams, dict):
        return config
    return config | {"teams": {side: team | {"types": {}} for side, team in teams.items() if isinstance(team, dict)}}
