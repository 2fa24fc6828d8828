"""A game with a task: the game itself, and around its judge the one that scores."""

import json
from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

from schemas.config.match_config import MatchConfig
from schemas.config.profile import Profile
from schemas.config.roster import RosterEntry
from schemas.config.scene import Scene
from schemas.config.task import TaskConfig
from schemas.messages.parameters import Setting
from schemas.messages.setup import Setup
from sim_host.game.ball_control import Arena
from sim_host.game.contract import Game
from sim_host.snapshot import Roster
from sim_host.task.judge import TaskJudge, TaskState


class TaskGame(NamedTuple):
    """A `sim_host.game.contract.Game` around that of the match."""

    task: TaskConfig
    game: Game
    duration: float | None
    """Simulated time after which the match ends in s; None for the end of the game."""
    seed: int

    @property
    def changed_by_layout(self) -> Collection[str]:
        """An operator who moves bodies changes the state of the game."""
        return ("game",)

    @property
    def arena(self) -> Arena:
        """What the game needs in the world."""
        return self.game.arena

    def fingerprint(self) -> dict[str, str]:
        """That of the game; the recording holds the text of the score's module."""
        return self.game.fingerprint()

    def setup(
        self, config: MatchConfig, profile: Profile, engine: Mapping[str, str], changed: Mapping[str, Setting]
    ) -> Setup:
        """The setup of the match."""
        return self.game.setup(config, profile, engine, changed)

    def start_scene(self, config: MatchConfig, profile: Profile) -> Scene:
        """The scene of a match file that names none."""
        return self.game.start_scene(config, profile)

    def check_team_sizes(self, robots: Sequence[RosterEntry]) -> None:
        """Check how many robots take part in the game."""
        self.game.check_team_sizes(robots)

    def judge(self, profile: Profile, roster: Roster) -> TaskJudge:
        """What judges and scores the ticks."""
        return TaskJudge(self.task, self.game.judge(profile, roster), self.duration, self.seed, profile.field, roster)

    def state_json(self, state: TaskState) -> str:
        """The complete state as JSON."""
        return json.dumps((self.game.state_json(state.game), *state[1:]))

    def state_from_json(self, text: str) -> TaskState:
        """The state in a text of `state_json`."""
        try:
            game, *rest = json.loads(text)
            return TaskState(self.game.state_from_json(game), *rest)
        except TypeError as error:  # other fields
            raise ValueError(str(error)) from None
