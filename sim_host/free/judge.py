"""The judge of a free game: it lets robots do as they like, until people end it."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple

from schemas.config.scene import SceneGame
from schemas.messages.soccer.game import ActionReply, GameState, GameView, RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, Phase, Score, TeamPhase
from sim_host.game.judging import Absence, Ruling
from sim_host.snapshot import Snapshot


class FreeState(NamedTuple):
    """The whole memory of a free game between two ticks."""

    clock: float = 0.0
    """s since it began."""
    over: bool = False

    @property
    def score(self) -> Score:
        """No goals."""
        return Score()

    @property
    def cyan_attacks(self) -> int:
        """Cyan's frame is the field frame."""
        return 1

    @property
    def absences(self) -> Mapping[str, Absence]:
        """No robot is off the field."""
        return {}

    @property
    def change_key(self) -> tuple[Any, ...]:
        """Whether the match is over."""
        return (self.over,)

    def attack(self, side: Side) -> int:
        """Sign of the x direction of a side's frame."""
        return side.attack(1)

    def game_state(self, tick: int, time: float, episode: int = 1) -> GameState:
        """The published state."""
        phase = Phase.FULL_TIME if self.over else Phase.PLAY
        state = GameState(tick=tick, time=time, phase=phase, running=not self.over, episode=episode)
        return state.replace(clock=self.clock)

    def after_layout_change(self, _names: Collection[str]) -> "FreeState":
        """An operator who moves bodies changes nothing that the game remembers."""
        return self


class FreeJudge:
    """A `sim_host.game.judging.Judge`."""

    def begin_at(self, game: SceneGame, _ball: tuple[float, float]) -> FreeState:
        """The state with which a scene begins."""
        return FreeState(clock=game.clock)

    def step(self, state: FreeState, snapshot: Snapshot, actions: Sequence[RefereeAction], dt: float) -> Ruling:
        """Judge one tick of `dt` in s."""
        replies = tuple(_reply(action, snapshot.tick) for action in actions)
        over = state.over or any(reply.accepted for reply in replies)
        return Ruling(FreeState(state.clock + dt, over), replies=replies)

    def views(self, state: FreeState, episode: int) -> dict[Side, GameView]:
        """Side → the game from its point of view."""
        phase = TeamPhase.FULL_TIME if state.over else TeamPhase.PLAY
        view = GameView(
            phase=phase, running=not state.over, clock=state.clock, our_score=0, their_score=0, episode=episode
        )
        return dict.fromkeys(Side, view)


def _reply(action: RefereeAction, tick: int) -> ActionReply:
    """A free game can be ended, by people and for a team over the limit of its account; it has no other action."""
    accepted = action.action is ActionName.END_GAME
    return ActionReply(accepted=accepted, reason="" if accepted else "a free game has no referee", tick=tick)
