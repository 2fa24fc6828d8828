"""The contract of a game."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any, Protocol

from schemas.config.match_config import MatchConfig
from schemas.config.profile import Profile
from schemas.config.roster import RosterEntry
from schemas.config.scene import Scene
from schemas.messages.parameters import Setting
from schemas.messages.setup import Setup
from sim_host.game.ball_control import Arena
from sim_host.game.judging import Judge
from sim_host.snapshot import Roster


class Game(Protocol):
    """The game of one match: its constants, and what makes its parts."""

    @property
    def changed_by_layout(self) -> Collection[str]:
        """Fields of the state that `PlayState.after_layout_change` may change."""

    @property
    def arena(self) -> Arena:
        """What the game needs in the world."""

    def fingerprint(self) -> dict[str, str]:
        """Part → digest of the program that computes it; a recording keeps it."""

    def setup(
        self, config: MatchConfig, profile: Profile, engine: Mapping[str, str], changed: Mapping[str, Setting]
    ) -> Setup:
        """The setup of the match; `engine` is the fingerprint, `changed` the live parameters that differ."""

    def start_scene(self, config: MatchConfig, profile: Profile) -> Scene:
        """The scene of a match file that names none.

        Raises:
            TouchlineError: the pitch has no room for the robots.
        """

    def check_team_sizes(self, robots: Sequence[RosterEntry]) -> None:
        """Check how many robots take part.

        Raises:
            TouchlineError: a side has too many or none.
        """

    def judge(self, profile: Profile, roster: Roster) -> Judge:
        """What judges the ticks of this roster."""

    def state_json(self, state: Any) -> str:
        """The complete state as JSON; floats keep every bit."""

    def state_from_json(self, text: str) -> Any:
        """The state in a text of `state_json`.

        Raises:
            ValueError: the text is not a state of this version's game.
        """
