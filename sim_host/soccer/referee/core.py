"""The referee: a function (state, snapshot, actions, dt) → ruling, without memory or other input."""

from collections.abc import Mapping, Sequence

from schemas.config.scene import SceneGame
from schemas.config.sections import Ball, Pitch
from schemas.config.soccer.rule_book import RuleBook
from schemas.frames import Pose
from schemas.messages.soccer.game import GameView, RefereeAction
from schemas.side import Side
from schemas.soccer.game import RESTARTS, OfficiatingMode, Phase, Score
from sim_host.game.judging import Ruling
from sim_host.snapshot import Roster, Snapshot
from sim_host.soccer.referee import refbox
from sim_host.soccer.referee.actions import execute, naming
from sim_host.soccer.referee.authority import is_due, judge
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.restart import Restart, Spot
from sim_host.soccer.referee.game.set_piece import started
from sim_host.soccer.referee.game.timing import Timing
from sim_host.soccer.referee.game_views import game_views
from sim_host.soccer.referee.match_constants import MatchConstants
from sim_host.soccer.referee.procedures.periods import advance
from sim_host.soccer.referee.rules import first_decision
from sim_host.soccer.referee.ruling_draft import RulingDraft
from sim_host.soccer.referee.situation import situation_after


class Referee:
    """The referee of one match; holds the constants of the match and no state."""

    def __init__(
        self,
        book: RuleBook,
        pitch: Pitch,
        ball: Ball,
        roster: Roster,
        *,
        duration: float | None,
        kick_off: Side,
        automatic: bool,
        starts: Mapping[str, Pose],
        mode: OfficiatingMode = OfficiatingMode.AUTOMATIC,
        proposal: float = 0.0,
        winner: bool | None = None,
        advantage: float | None = None,
    ) -> None:
        """The constants of a match.

        Args:
            duration: playing time of all halves in s; the rule book's if None.
            kick_off: the side that kicks off the first half.
            automatic: the match begins at the first step; otherwise it waits for an action.
            starts: start pose of each robot in the field frame, for cyan attacking +x.
            mode: whether the referee, people, or both decide.
            proposal: s that people have to overrule a decision, in mixed officiating.
            winner: whether a level match goes on until a side wins; the rule book's choice if None.
            advantage: s for which play goes on after a foul for a side that keeps the ball; the rule book's if None.

        Raises:
            TouchlineError: a robot of the roster has no start pose.
        """
        periods = book.periods
        half = periods.half_duration if duration is None else duration / periods.halves
        goes_on = bool(periods.needs_winner) if winner is None else winner
        self._match = MatchConstants(
            book,
            pitch,
            ball,
            roster,
            half,
            kick_off,
            automatic,
            starts,
            mode,
            proposal,
            goes_on,
            book.restarts.advantage if advantage is None else advantage,
        )

    def begin(self) -> RefereeState:
        """The state before the first tick."""
        return RefereeState(Phase.PRE_GAME, Timing(self._match.half_duration), self._match.kick_off)

    def begin_at(self, game: SceneGame, ball: Spot) -> RefereeState:
        """The state with which a scene begins, in the first half; a restart is taken from where the ball lies."""
        is_restart = game.phase in RESTARTS
        running = game.running or game.phase is Phase.PLAY
        return self.begin()._replace(
            phase=game.phase,
            side=game.side,
            spot=ball if is_restart else None,
            running=running,
            timing=Timing(
                self._match.half_duration,
                clock=game.clock,
                runs=running or game.phase not in (Phase.PRE_GAME, Phase.KICK_OFF),
            ),
            set_piece=started(Restart(game.phase, game.side, ball)) if is_restart and running else None,
            score=Score(cyan=game.score.cyan, magenta=game.score.magenta),
        )

    def step(self, state: RefereeState, snapshot: Snapshot, actions: Sequence[RefereeAction], dt: float) -> Ruling:
        """Judge one tick of `dt` in s: first the rules, then the actions, then the procedures."""
        match = self._match
        situation = situation_after(match, state, snapshot, dt)
        now = situation.state
        if now.refbox_gone is not None or state.refbox_gone is not None:
            situation = refbox.with_offender(situation)
            now = situation.state
        found = (
            None
            if is_due(now.proposal)
            else first_decision(situation, clocks_alone=match.mode is OfficiatingMode.MANUAL)
        )
        changed = (now.refbox_gone is None) is not (state.refbox_gone is None)
        if found is None and not actions and not changed and is_quiet(now):
            return Ruling(now)
        draft = RulingDraft(match, snapshot, now)
        if changed:
            refbox.change(draft)
        judge(draft, found)
        replies = tuple(execute(draft, action) for action in actions)
        naming.decide_overdue(draft)
        advance(draft)
        return Ruling(draft.state, tuple(draft.events), tuple(draft.placements), replies, draft.checkpoint)

    def views(self, state: RefereeState, episode: int) -> dict[Side, GameView]:
        """Side → the game from its point of view; `spot` in m, in the side's team frame."""
        return game_views(state, self._match.roster, episode)


def is_quiet(state: RefereeState) -> bool:
    """Whether no procedure has anything to do: the ball is in play, and no timer is pending."""
    return (
        state.phase is Phase.PLAY
        and state.set_piece is None
        and not state.participation.silent
        and not state.questions
        and state.advantage is None
        and not is_due(state.proposal)
    )
