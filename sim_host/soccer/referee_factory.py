"""Makes the referee of a match, for a running match and for its resimulation."""

from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import OfficiatingConfig
from schemas.config.profile import Profile
from schemas.config.soccer.rule_book import RuleBook
from sim_host.match.live_parameters import LiveParameters
from sim_host.snapshot import Roster
from sim_host.soccer.referee.core import Referee
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.start_poses import start_poses
from sim_host.soccer.start_scene import opening_layout


def make_referee(
    book: RuleBook, profile: Profile, roster: Roster, duration: float | None, options: OfficiatingConfig
) -> Referee:
    """The referee of a match with this roster; `duration` is the playing time in s, the rule book's if None."""
    return Referee(
        book,
        profile.field,
        profile.ball,
        roster,
        duration=duration,
        kick_off=options.kick_off,
        automatic=options.automatic,
        starts=start_poses(roster, profile.field, book.restarts)[0],
        mode=options.mode,
        proposal=options.proposal,
        winner=options.winner,
        advantage=options.advantage,
    )


def opening_state(config: MatchConfig) -> RefereeState:
    """The state of the referee at tick 0 of a match.

    Raises:
        TouchlineError: the profile, the rule book or the scene of the match file is invalid.
    """
    live_parameters, book = LiveParameters.of(config), config.load_rule_book()
    start, began = opening_layout(config, live_parameters, book)
    roster = Roster.of_entries(began.layout.robots, live_parameters.types)
    referee = make_referee(book, live_parameters.profile, roster, config.duration, config.referee)
    return referee.begin_at(start.game, began.ball)
