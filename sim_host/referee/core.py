"""The referee: (state, snapshot, actions, dt) → ruling; it remembers nothing and sees nothing else."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from schemas.frames import Pose
from schemas.game import RESTARTS, ActionReply, GameEvent, Phase, RefereeAction
from schemas.host import Placement
from schemas.profile import Ball, Field
from schemas.rule_book import RuleBook
from schemas.scene import SceneGame
from schemas.side import Side
from sim_host.referee.actions import obey
from sim_host.referee.flow import carry_out, progress
from sim_host.referee.match import Match
from sim_host.referee.rules import first_decision
from sim_host.referee.scene import look
from sim_host.referee.state import RefereeState, Spot
from sim_host.referee.turn import Turn
from sim_host.snapshot import Roster, Snapshot


@dataclass(frozen=True, slots=True)
class Ruling:
    """What the referee made of one tick."""

    state: RefereeState
    events: tuple[GameEvent, ...] = ()
    """In order of time."""
    placements: tuple[Placement, ...] = ()
    """Bodies to set down at rest before the next tick."""
    replies: tuple[ActionReply, ...] = ()
    """One for each action, in their order."""
    checkpoint: bool = False
    """START of a kick-off was given in this tick."""


class Referee:
    """One match's referee; holds its constants and no state."""

    def __init__(
        self,
        book: RuleBook,
        pitch: Field,
        ball: Ball,
        roster: Roster,
        *,
        duration: float | None,
        kick_off: Side,
        automatic: bool,
        starts: Mapping[str, Pose],
    ) -> None:
        """The constants of a match.

        Args:
            duration: playing time of all halves in s; the rule book's when not given.
            kick_off: who kicks off the first half.
            automatic: the match begins at the first step; otherwise it waits for an action.
            starts: start pose of each robot in the field frame, for cyan attacking +x.

        Raises:
            TouchlineError: a robot of the roster has no start pose.
        """
        periods = book.periods
        half = periods.half_duration if duration is None else duration / periods.halves
        self._match = Match(book, pitch, ball, roster, half, kick_off, automatic, starts)

    def begin(self) -> RefereeState:
        """The state before the first tick."""
        return RefereeState(Phase.PRE_GAME, half_limit=self._match.half_duration, kick_off=self._match.kick_off)

    def begin_at(self, game: SceneGame, ball: Spot) -> RefereeState:
        """The state with which a scene begins: in the first half, a restart to be taken from where the ball lies."""
        is_restart = game.phase in RESTARTS
        running = game.running or game.phase is Phase.PLAY
        return dataclasses.replace(
            self.begin(),
            phase=game.phase,
            side=game.side,
            spot=ball if is_restart else None,
            running=running,
            clock=game.clock,
            clock_runs=running or game.phase not in (Phase.PRE_GAME, Phase.KICK_OFF),
            score=game.score,
        )

    def step(self, state: RefereeState, snapshot: Snapshot, actions: Sequence[RefereeAction], dt: float) -> Ruling:
        """Judge one tick of `dt` in s: the rules on what happened, then the actions, then what time brings."""
        scene = look(self._match, state, snapshot, dt)
        found = first_decision(scene)
        if found is None and not actions and scene.state.phase is Phase.PLAY:
            return Ruling(scene.state)
        turn = Turn(self._match, snapshot, scene.state)
        if found is not None:
            rule, decision = found
            carry_out(turn, rule.name, decision)
        replies = tuple(obey(turn, action) for action in actions)
        progress(turn)
        return Ruling(turn.state, tuple(turn.events), tuple(turn.placements), replies, turn.checkpoint)
