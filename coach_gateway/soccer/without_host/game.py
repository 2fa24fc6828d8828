"""The game as people or a league's box decide it, where no host sees the ball. Pure."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from schemas.messages.setup import Setup
from schemas.messages.soccer.game import DisciplinaryRecord, GameState, RefereeAction
from schemas.soccer.game import RESTARTS, SIDED, ActionName, GameStage, OffField, Phase, Score


class _Record(NamedTuple):
    """What an action adds to the record of a robot."""

    yellow: int = 0
    red: int = 0
    off_field: OffField | None = None


_RECORDS: Mapping[ActionName, _Record] = {
    ActionName.YELLOW_CARD: _Record(yellow=1),
    ActionName.DOUBLE_YELLOW: _Record(yellow=1, off_field=OffField.SECOND_YELLOW),
    ActionName.RED_CARD: _Record(red=1, off_field=OffField.RED_CARD),
    ActionName.REPAIR: _Record(off_field=OffField.REPAIR),
    ActionName.SUBSTITUTE: _Record(off_field=OffField.SUBSTITUTION),
    ActionName.ENTER: _Record(),
}
_ENDED = (Phase.HALF_TIME, Phase.FULL_TIME)


class GameWithoutHost:
    """Follows the actions.

    START lets play begin, as the box's START does. A restart becomes play when the time is up that the rules give the
    ball to be in play. No time ends a half: people or the box do. Teams change ends with each half.
    """

    def __init__(self, setup: Setup) -> None:
        self.state = GameState(tick=0, time=0.0, phase=Phase.PRE_GAME)
        self._setup, self._tick = setup, setup.time.tick
        self._clock_runs = False
        self._acts: Mapping[ActionName, Callable[[RefereeAction], str]] = {
            ActionName.START: self._start,
            ActionName.STOP: self._stop,
            ActionName.GOAL: lambda action: self._count(action, 1),
            ActionName.CANCEL_GOAL: lambda action: self._count(action, -1),
            ActionName.END_HALF: self._end_half,
            ActionName.END_GAME: lambda _: self._end(Phase.FULL_TIME),
            **{ActionName(phase.value): self._signal for phase in RESTARTS},
            **dict.fromkeys(_RECORDS, self._record),
        }

    def advance(self, time: float) -> None:
        """Let the clocks run until `time`, in s since the beginning."""
        state, time = self.state, round(time, 4)
        passed = time - state.time
        left = max(0.0, state.left - passed) if state.left is not None else None
        self._change(
            tick=round(time / self._tick),
            time=time,
            clock=state.clock + passed * self._clock_runs,
            effective=state.effective + passed * (state.phase is Phase.PLAY),
            left=left,
        )
        if left == 0.0:
            self._change(phase=Phase.PLAY, side=None, left=None)

    def act(self, action: RefereeAction) -> str:
        """Carry out an action; why that is impossible, or empty."""
        rule = self._acts.get(action.action)
        return rule(action) if rule is not None else f"{action.action} needs a host, which sees ball and robots"

    def _change(self, **fields: Any) -> str:
        self.state = self.state.replace(**fields)
        return ""

    def _start(self, _: RefereeAction) -> str:
        state = self.state
        if state.running or state.phase is Phase.FULL_TIME:
            return "the game is running" if state.running else "nothing can be started, the phase is full_time"
        if state.phase is Phase.HALF_TIME:
            return self._begin_half()
        self._clock_runs = state.stage is not GameStage.SHOOT_OUT
        if state.phase not in RESTARTS:
            return self._change(phase=Phase.PLAY, running=True)
        limits = self._setup.restarts
        return self._change(
            running=True, left=limits.penalty_limit if state.phase is Phase.PENALTY else limits.time_limit
        )

    def _begin_half(self) -> str:
        state = self.state
        stage = self._next_stage()
        if stage is None:  # the score was changed in the break
            return self._end(Phase.FULL_TIME)
        shoot_out = Score() if stage is GameStage.SHOOT_OUT else None
        turned = {} if shoot_out is not None else {"half": state.half + 1, "cyan_attacks": -state.cyan_attacks}
        return self._change(phase=Phase.STOPPED, stage=stage, shoot_out=shoot_out, **turned)

    def _next_stage(self) -> GameStage | None:
        """The stage that follows on this half; None after the last one that the match requires."""
        state, periods, winner = self.state, self._setup.periods, self._setup.referee.winner
        wanted = periods.needs_winner if winner is None else winner
        is_open = bool(wanted) and state.score.cyan == state.score.magenta
        if state.stage is not GameStage.SHOOT_OUT:
            if state.half < periods.halves:
                return GameStage.REGULAR
            if state.half < periods.halves + periods.extra_halves and (is_open or state.half > periods.halves):
                return GameStage.EXTRA_TIME
            if is_open and periods.shoot_out_kicks:
                return GameStage.SHOOT_OUT
        return None

    def _stop(self, _: RefereeAction) -> str:
        if self.state.phase in _ENDED:
            return ""  # nobody plays
        return self._change(phase=Phase.STOPPED, side=None, running=False, left=None)

    def _signal(self, action: RefereeAction) -> str:
        phase = Phase(action.action.value)
        if self.state.phase in _ENDED:
            return f"no half has begun, the phase is {self.state.phase}"
        if phase in SIDED and action.side is None:
            return f"{action.action} needs a side"
        return self._change(phase=phase, side=action.side if phase in SIDED else None, running=False, left=None)

    def _count(self, action: RefereeAction, goals: int) -> str:
        field = "shoot_out" if self.state.shoot_out is not None else "score"
        score: Score = getattr(self.state, field)
        if action.side is None or score.of(action.side) + goals < 0:
            return f"{action.action} needs a side" + (" with a goal" if goals < 0 else "")
        return self._change(**{field: score.plus(action.side, goals)})

    def _end_half(self, _: RefereeAction) -> str:
        if self.state.phase in (Phase.PRE_GAME, *_ENDED):
            return f"no half has begun, the phase is {self.state.phase}"
        return self._end(Phase.HALF_TIME if self._next_stage() is not None else Phase.FULL_TIME)

    def _end(self, phase: Phase) -> str:
        self._clock_runs = False
        return self._change(phase=phase, side=None, running=False, left=None)

    def _record(self, action: RefereeAction) -> str:
        name, added = action.robot, _RECORDS[action.action]
        if name is None or name not in self._setup.sides:
            return f"{action.action} needs the name of a robot"
        old = self.state.robots.get(name, DisciplinaryRecord())
        record = DisciplinaryRecord(
            yellow=old.yellow + added.yellow,
            red=old.red + added.red,
            off_field=added.off_field or (old.off_field if action.action is ActionName.YELLOW_CARD else None),
        )
        others = {other: kept for other, kept in self.state.robots.items() if other != name}
        return self._change(robots=others if record == DisciplinaryRecord() else {**others, name: record})
