"""How play comes to rest: a break, full time, or a side that cannot field enough robots."""

from schemas.game import EventKind, Phase
from schemas.side import Side
from sim_host.referee import discipline
from sim_host.referee.turn import Turn

FORFEIT = "flow"
"""The rule that a forfeit is decided by."""


def rest(turn: Turn, phase: Phase, until: float | None) -> None:
    """Nobody plays in this phase; it lasts until the timer is at `until` s, or for good."""
    state = turn.state
    turn.state = state._replace(
        phase=phase,
        side=None,
        spot=None,
        running=False,
        pending=None,
        set_piece=None,
        proposal=None,
        people=discipline.new_stoppage(state.people),
        timing=state.timing.anew(until, runs=False),
    )


def end_match(turn: Turn, rule: str, text: str) -> None:
    """Full time."""
    rest(turn, Phase.FULL_TIME, None)
    turn.say(EventKind.FULL_TIME, rule, text, score=turn.state.score)


def is_given_up(turn: Turn) -> bool:
    """End the match if a side cannot field as many robots as the rule book asks for; whether it was ended.

    Of two such sides the one with fewer robots forfeits; where both have as few, neither has won.
    """
    least = turn.book.people.least_robots
    fielded = {side: discipline.can_play(turn, side) for side in Side}
    if min(fielded.values()) >= least:
        return False
    if fielded[Side.CYAN] == fielded[Side.MAGENTA]:
        end_match(turn, FORFEIT, f"full time, neither side can field {least} robots")
    else:
        _forfeit(turn, min(fielded, key=lambda side: fielded[side]))
    return True


def _forfeit(turn: Turn, loser: Side) -> None:
    """End the match: won by the other side, by as many goals as the rule book says at least."""
    state, winner = turn.state, loser.opponent
    goals = max(0, state.score.of(loser) + turn.book.people.forfeit_goals - state.score.of(winner))
    turn.state = state._replace(score=state.score.plus(winner, goals))
    left, least = discipline.can_play(turn, loser), turn.book.people.least_robots
    turn.say(
        EventKind.FORFEIT,
        FORFEIT,
        f"{loser} forfeits: it can field {left} robots, {least} are asked",
        side=loser,
        score=turn.state.score,
        measured=left,
        limit=least,
        unit="robots",
    )
    end_match(turn, FORFEIT, f"full time, {winner} wins by forfeit")
