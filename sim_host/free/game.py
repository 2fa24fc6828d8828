"""The game `free`: robots, obstacles, things to push and zones; its score is a function of the user."""

import json
from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

from schemas.config.free import FreeConfig
from schemas.config.match_config import MatchConfig
from schemas.config.profile import Profile
from schemas.config.roster import RosterEntry
from schemas.config.scene import Scene
from schemas.errors import TouchlineError
from schemas.messages.parameters import Setting
from schemas.messages.setup import Setup
from sim_host.free.judge import FreeJudge, FreeState
from sim_host.free.no_ball import NoBall
from sim_host.game.ball_control import Arena
from sim_host.physics.pitch import Furniture
from sim_host.snapshot import Roster

ARENA = Arena(NoBall, Furniture(ball=False, goals=False))
"""No ball, no goals."""


class Free(NamedTuple):
    """A `sim_host.game.contract.Game`: the constants of one match."""

    config: FreeConfig
    duration: float
    """Simulated time after which the match ends in s."""
    seed: int

    @classmethod
    def of_match(cls, config: MatchConfig) -> "Free":
        """The game of a match file."""
        assert config.free is not None and config.duration is not None  # as the config checks
        return cls(config.free, config.duration, config.seed)

    @property
    def arena(self) -> Arena:
        """The empty floor."""
        return ARENA

    @property
    def changed_by_layout(self) -> Collection[str]:
        """An operator who moves bodies changes nothing of the state."""
        return ()

    def fingerprint(self) -> dict[str, str]:
        """Nothing: the recording holds the text of the score's module."""
        return {}

    def setup(
        self, config: MatchConfig, profile: Profile, engine: Mapping[str, str], changed: Mapping[str, Setting]
    ) -> Setup:
        """The setup of the match; the rule book in it has no effect."""
        return Setup.of(config, profile, config.load_rule_book(), engine, changed)

    def start_scene(self, _config: MatchConfig, _profile: Profile) -> Scene:
        """A free game begins in the scene of its match file, which the config checks."""
        raise TouchlineError('scene is missing; the game "free" needs one')

    def check_team_sizes(self, robots: Sequence[RosterEntry]) -> None:
        """Any number of robots may take part."""

    def judge(self, profile: Profile, roster: Roster) -> FreeJudge:
        """What scores the ticks."""
        return FreeJudge(self.config, self.duration, self.seed, profile.field, roster)

    def state_json(self, state: FreeState) -> str:
        """The complete state as JSON."""
        return json.dumps(state)

    def state_from_json(self, text: str) -> FreeState:
        """The state in a text of `state_json`."""
        try:
            return FreeState(*json.loads(text))
        except TypeError as error:  # other fields
            raise ValueError(str(error)) from None
