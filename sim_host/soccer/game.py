"""Soccer as a game: the referee of a match, its ball, and its start."""

from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import OfficiatingConfig
from schemas.config.profile import Profile
from schemas.config.roster import RosterEntry
from schemas.config.scene import Scene
from schemas.config.soccer.rule_book import RuleBook
from schemas.config.team_sizes import check_team_sizes
from schemas.messages.parameters import Setting
from schemas.messages.setup import Setup
from sim_host.game.ball_control import Arena
from sim_host.snapshot import Roster
from sim_host.soccer.ball.ball_handling import BallHandling
from sim_host.soccer.referee.core import Referee
from sim_host.soccer.referee.fingerprint import referee_fingerprint
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.state_json import state_from_json, state_json
from sim_host.soccer.start_poses import start_poses
from sim_host.soccer.start_scene import start_scene

ARENA = Arena(BallHandling)
"""Possession, dribbling and kicks."""


class Soccer(NamedTuple):
    """The game of a match of soccer: the constants that the referee needs besides profile and roster."""

    book: RuleBook
    duration: float | None
    """Playing time of all halves in s; None for the rule book's."""
    options: OfficiatingConfig

    @classmethod
    def of_match(cls, config: MatchConfig) -> "Soccer":
        """The game of a match file.

        Raises:
            TouchlineError: the rule book of the match file is invalid.
        """
        return cls(config.load_rule_book(), config.duration, config.referee)

    @classmethod
    def of_setup(cls, setup: Setup) -> "Soccer":
        """The game of a match that is known by its host's setup."""
        return cls(setup.rule_book(), setup.duration, setup.referee)

    @property
    def changed_by_layout(self) -> Collection[str]:
        """Fields of the referee's state that an operator who moves bodies changes."""
        return "participation", "evidence", "set_piece", "proposal", "advantage"

    @property
    def arena(self) -> Arena:
        """A ball and goals."""
        return ARENA

    def fingerprint(self) -> dict[str, str]:
        """Digest of the referee's program."""
        return {"referee": referee_fingerprint()}

    def setup(
        self, config: MatchConfig, profile: Profile, engine: Mapping[str, str], changed: Mapping[str, Setting]
    ) -> Setup:
        """The setup of the match with its rule book."""
        return Setup.of(config, profile, self.book, engine, changed)

    def start_scene(self, config: MatchConfig, profile: Profile) -> Scene:
        """Robots at their start poses, the ball on the centre mark."""
        return start_scene(config, profile, self.book.restarts)

    def check_team_sizes(self, robots: Sequence[RosterEntry]) -> None:
        """Check that no side has more robots than the rule book allows."""
        check_team_sizes(robots, self.book)

    def judge(self, profile: Profile, roster: Roster) -> Referee:
        """The referee."""
        options = self.options
        return Referee(
            self.book,
            profile.field,
            profile.ball,
            roster,
            duration=self.duration,
            kick_off=options.kick_off,
            automatic=options.automatic,
            starts=start_poses(roster, profile.field, self.book.restarts)[0],
            mode=options.mode,
            proposal=options.proposal,
            winner=options.winner,
            advantage=options.advantage,
        )

    def state_json(self, state: RefereeState) -> str:
        """The complete state of the referee as JSON."""
        return state_json(state)

    def state_from_json(self, text: str) -> RefereeState:
        """The state of the referee in a text of `state_json`."""
        return state_from_json(text)
