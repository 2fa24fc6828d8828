"""The game `free`: robots, obstacles and things to push, without a ball; its task scores it."""

import json
from collections.abc import Collection, Mapping, Sequence

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


class Free:
    """A `sim_host.game.contract.Game`, which needs no numbers of the match."""

    @property
    def arena(self) -> Arena:
        """The empty floor."""
        return ARENA

    @property
    def changed_by_layout(self) -> Collection[str]:
        """An operator who moves bodies changes nothing of the state."""
        return ()

    def fingerprint(self) -> dict[str, str]:
        """Nothing: it computes no more than a clock."""
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

    def judge(self, _profile: Profile, _roster: Roster) -> FreeJudge:
        """What judges the ticks."""
        return FreeJudge()

    def state_json(self, state: FreeState) -> str:
        """The complete state as JSON."""
        return json.dumps(state)

    def state_from_json(self, text: str) -> FreeState:
        """The state in a text of `state_json`."""
        try:
            return FreeState(*json.loads(text))
        except TypeError as error:  # other fields
            raise ValueError(str(error)) from None
