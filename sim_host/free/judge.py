"""The judge of a free game: asks the score function each tick, and ends the match."""

import json
from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple

from schemas.config.free import FreeConfig, score_text
from schemas.config.scene import SceneGame
from schemas.config.sections import Pitch
from schemas.messages.soccer.game import ActionReply, GameEvent, GameState, GameView, RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, EventKind, Phase, Score, TeamPhase
from sim_host.free.score import Moment, ScoreFunction, call_score, load_score, memory_text
from sim_host.game.judging import Absence, Ruling
from sim_host.snapshot import Roster, Snapshot


class FreeState(NamedTuple):
    """The whole memory of a free game between two ticks."""

    duration: float
    """Simulated time after which it ends in s."""
    clock: float = 0.0
    """s since it began."""
    value: float | None = None
    """The score; None before the first tick."""
    over: bool = False
    memory: str = "null"
    """What the score function remembers, as JSON."""

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
        """The score, and whether the match is over."""
        return self.value, self.over

    def attack(self, side: Side) -> int:
        """Sign of the x direction of a side's frame."""
        return side.attack(1)

    def game_state(self, tick: int, time: float, episode: int = 1) -> GameState:
        """The published state."""
        phase = Phase.FULL_TIME if self.over else Phase.PLAY
        state = GameState(tick=tick, time=time, phase=phase, running=not self.over, episode=episode)
        return state.replace(clock=self.clock, left=max(0.0, self.duration - self.clock), value=self.value)

    def after_layout_change(self, _names: Collection[str]) -> "FreeState":
        """An operator who moves bodies changes nothing that the game remembers."""
        return self


class FreeJudge:
    """A `sim_host.game.judging.Judge`."""

    def __init__(self, free: FreeConfig, duration: float, seed: int, pitch: Pitch, roster: Roster) -> None:
        self._free = free
        self._duration = duration
        self._seed = seed
        self._pitch = pitch
        self._roster = roster
        self._zones = {zone.name: zone for zone in free.zones}
        self._function: ScoreFunction | None = None

    def begin_at(self, game: SceneGame, _ball: tuple[float, float]) -> FreeState:
        """The state with which a scene begins."""
        return FreeState(self._duration, clock=game.clock)

    def step(self, state: FreeState, snapshot: Snapshot, actions: Sequence[RefereeAction], dt: float) -> Ruling:
        """Score one tick of `dt` in s.

        Raises:
            TouchlineError: the score function raises, or returns what is no score.
        """
        replies = tuple(_reply(action, snapshot.tick) for action in actions)
        if state.over:
            return Ruling(state, replies=replies)
        if self._function is None:
            self._function = load_score(self._free)
        score = call_score(self._free, self._function, self._moment(state, snapshot))
        clock = state.clock + dt
        is_ended = any(reply.accepted for reply in replies)
        over = bool(score.over) or is_ended or clock >= self._duration - dt / 2
        memory = memory_text(self._free, score.memory)
        after = FreeState(self._duration, clock, float(score.value), over, memory)
        happened = [(EventKind.NOTE, " ".join(str(text).split())) for text in score.events]
        if over:
            text = score_text(score.value, self._free.unit)
            happened.append((EventKind.FULL_TIME, f"ends after {clock:.2f} s with the score {text}"))
        tick, time = snapshot.tick, snapshot.time
        events = [
            GameEvent(tick=tick, time=time, clock=clock, kind=kind, rule="score", text=text) for kind, text in happened
        ]
        return Ruling(after, tuple(events), replies=replies)

    def views(self, state: FreeState, episode: int) -> dict[Side, GameView]:
        """Side → the game from its point of view."""
        phase, left = TeamPhase.FULL_TIME if state.over else TeamPhase.PLAY, max(0.0, state.duration - state.clock)
        running, clock = not state.over, state.clock
        view = GameView(
            phase=phase, running=running, clock=clock, our_score=0, their_score=0, left=left, episode=episode
        )
        return dict.fromkeys(Side, view)

    def _moment(self, state: FreeState, snapshot: Snapshot) -> Moment:
        names = self._roster.names
        return Moment(
            tick=snapshot.tick,
            time=snapshot.time,
            robots=dict(zip(names, snapshot.robots, strict=True)),
            obstacles={one.name: one for one in snapshot.obstacles},
            contacts=frozenset((names[one], names[other]) for one, other in snapshot.contacts),
            zones=self._zones,
            pitch=self._pitch,
            memory=json.loads(state.memory),
            seed=self._seed,
        )


def _reply(action: RefereeAction, tick: int) -> ActionReply:
    """A free game can be ended, by people and for a team over the limit of its account; it has no other action."""
    accepted = action.action is ActionName.END_GAME
    return ActionReply(accepted=accepted, reason="" if accepted else "a free game has no referee", tick=tick)
