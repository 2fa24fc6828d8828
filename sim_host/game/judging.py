"""How a game judges the ticks of its match.

A game is pure: its memory is a state that the match passes to each step, so that a recording can hold the state at
checkpoints and a resimulation can continue from it.
"""

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from schemas.config.roster import Placement
from schemas.config.scene import SceneGame
from schemas.messages.soccer.game import ActionReply, GameEvent, GameState, GameView, RefereeAction
from schemas.side import Side
from schemas.soccer.game import Score
from sim_host.snapshot import Snapshot


class Absence(Protocol):
    """A robot off the field."""

    @property
    def why(self) -> str:
        """The reason, as published in the world."""


class PlayState(Protocol):
    """The state of a game between two ticks: its whole memory, immutable. A named tuple."""

    _fields: tuple[str, ...]

    @property
    def over(self) -> bool:
        """The match has been played to its end."""

    @property
    def clock(self) -> float:
        """Game clock in s."""

    @property
    def score(self) -> Score:
        """Points of both sides."""

    @property
    def cyan_attacks(self) -> int:
        """Sign of the x direction that cyan attacks, which gives the team frames."""

    @property
    def absences(self) -> Mapping[str, Absence]:
        """Robots off the field: their commands are ignored."""

    @property
    def change_key(self) -> tuple[Any, ...]:
        """Differs from that of the tick before when the state has to be published."""

    def _replace(self, **fields: Any) -> Any:
        """The state with other fields."""

    def attack(self, side: Side) -> int:
        """Sign of the x direction that a side attacks."""

    def game_state(self, tick: int, time: float, episode: int = 1) -> GameState:
        """The published state at this tick and simulated time in s, in this episode."""

    def after_layout_change(self, names: Collection[str]) -> Any:
        """The state after an operator has moved bodies, or left these robots on the field."""


class Ruling(NamedTuple):
    """The result of the game's step in one tick."""

    state: Any
    """`PlayState`."""
    events: tuple[GameEvent, ...] = ()
    """In order of time."""
    placements: tuple[Placement, ...] = ()
    """Bodies to place at rest before the next tick."""
    replies: tuple[ActionReply, ...] = ()
    """One for each action, in their order."""
    checkpoint: bool = False
    """A checkpoint is made before the next tick."""


class Judge(Protocol):
    """Judges the ticks of a game with one roster; holds the constants of the match and no state."""

    def begin_at(self, game: SceneGame, ball: tuple[float, float]) -> Any:
        """The state with which a scene begins; `ball` is its place on the ground in m."""

    def step(self, state: Any, snapshot: Snapshot, actions: Sequence[RefereeAction], dt: float) -> Ruling:
        """Judge one tick of `dt` in s."""

    def views(self, state: Any, episode: int) -> Mapping[Side, GameView]:
        """Side → the game from its point of view, in its team frame."""
