"""The table of games: the one module that imports the rooms of them."""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from schemas.config.match_config import MatchConfig
from schemas.config.task import GameName
from schemas.messages.setup import Setup
from sim_host.free.game import ARENA as FREE_ARENA
from sim_host.free.game import Free
from sim_host.game.ball_control import Arena
from sim_host.game.contract import Game
from sim_host.soccer.game import ARENA as SOCCER_ARENA
from sim_host.soccer.game import Soccer
from sim_host.task.game import TaskGame


class GameRow(NamedTuple):
    """One game."""

    arena: Arena
    of_match: Callable[[MatchConfig], Game]
    """The game of a match file; raises a `TouchlineError` for invalid numbers."""
    of_setup: Callable[[Setup], Game] | None = None
    """The game of a match that is known by its host's setup; None where that does not suffice."""


GAMES: Mapping[GameName, GameRow] = {
    GameName.SOCCER: GameRow(SOCCER_ARENA, Soccer.of_match, Soccer.of_setup),
    GameName.FREE: GameRow(FREE_ARENA, lambda _: Free()),
}


def game_of_match(config: MatchConfig) -> Game:
    """The game of a match file.

    Raises:
        TouchlineError: the numbers of the game are invalid.
    """
    if config.task is None:
        return GAMES[config.game].of_match(config)
    game = GAMES[config.game].of_match(config.model_copy(update={"duration": None}))
    return TaskGame(config.task, game, config.duration, config.seed)


def game_of_recording(config: MatchConfig | None, setup: Setup | None) -> Game | None:
    """The game of a recorded match file, or else of its host's setup; None if neither suffices.

    Raises:
        TouchlineError: the numbers of the game are not recorded.
    """
    if config is not None:
        return game_of_match(config)
    of_setup = GAMES[setup.game].of_setup if setup is not None and setup.task is None else None
    return of_setup(setup) if of_setup is not None and setup is not None else None


def arena_of_recording(config: MatchConfig | None, setup: Setup | None) -> Arena:
    """What the recorded game needs in the world; soccer's if neither match file nor setup is recorded."""
    recorded = config or setup
    return GAMES[recorded.game if recorded is not None else GameName.SOCCER].arena
