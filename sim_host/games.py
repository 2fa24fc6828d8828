"""The table of games: the one module that imports the rooms of them."""

from schemas.config.match_config import MatchConfig
from schemas.messages.setup import Setup
from sim_host.game.ball_control import MakeBallControl
from sim_host.game.contract import Game
from sim_host.soccer.ball.ball_handling import BallHandling
from sim_host.soccer.game import Soccer

BALL_CONTROL: MakeBallControl = BallHandling
"""What moves the ball in a recorded match; unlike its game, it needs no numbers but the profile's."""


def game_of_match(config: MatchConfig) -> Game:
    """The game of a match file.

    Raises:
        TouchlineError: the numbers of the game are invalid.
    """
    return Soccer.of_match(config)


def game_of_recording(config: MatchConfig | None, setup: Setup | None) -> Game | None:
    """The game of a recorded match file, or else of its host's setup; None if there is neither.

    Raises:
        TouchlineError: the numbers of the game are not recorded.
    """
    if config is not None:
        return game_of_match(config)
    return Soccer.of_setup(setup) if setup is not None else None
