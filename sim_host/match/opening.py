"""What a match begins with: the scene, its layout, and the state of the game."""

from typing import Any

from schemas.config.match_config import MatchConfig
from schemas.config.scene import Scene
from schemas.errors import TouchlineError
from sim_host.game.contract import Game
from sim_host.match.live_parameters import LiveParameters
from sim_host.snapshot import Roster
from sim_host.staging.layout import LayoutChange, Specs, check_layout, scene_layout
from sim_host.staging.variation import varied

_MOST_DRAWS = 100
"""Starts that are drawn from a seed before the scene is refused."""


def opening_layout(config: MatchConfig, live_parameters: LiveParameters, game: Game) -> tuple[Scene, LayoutChange]:
    """The scene that a match begins with, and the layout that it makes.

    With a task, the start is drawn from the seed, until one is found in which no bodies overlap.

    Raises:
        TouchlineError: a side has more robots than the game allows, or the pitch has no room for a body.
    """
    profile = live_parameters.profile
    scene = config.scene if config.scene is not None else game.start_scene(config, profile)
    furniture = game.arena.furniture
    specs = Specs(profile.field, profile.ball, live_parameters.types, game.check_team_sizes, furniture)
    is_drawn = config.task is not None and bool(scene.vary)
    check_layout(scene_layout(scene, furniture, "").layout, specs, ())  # what no draw changes
    for attempt in range(_MOST_DRAWS if is_drawn else 1):
        start = varied(scene, config.seed, attempt) if is_drawn else scene
        began = scene_layout(start, furniture, "")
        try:
            check_layout(began.layout, specs, began.layout.names)
            return start, began
        except TouchlineError as error:
            fault = error
    raise TouchlineError(f"none of {_MOST_DRAWS} starts fits: {fault}") if is_drawn else fault


def opening_state(config: MatchConfig, game: Game) -> Any:
    """The state of the game at tick 0 of a match.

    Raises:
        TouchlineError: the profile, the rule book or the scene of the match file is invalid.
    """
    live_parameters = LiveParameters.of(config)
    start, began = opening_layout(config, live_parameters, game)
    roster = Roster.of_entries(began.layout.robots, live_parameters.types)
    return game.judge(live_parameters.profile, roster).begin_at(start.game, began.ball)
