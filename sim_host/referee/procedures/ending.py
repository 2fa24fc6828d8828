"""How play comes to rest: a break, full time, or a side that cannot field enough robots."""

from schemas.game import EventKind, Phase
from schemas.side import Side
from sim_host.referee.procedures import discipline
from sim_host.referee.ruling_draft import RulingDraft

RULE = "periods"
"""The rule that a forfeit is decided by."""


def suspend_play(draft: RulingDraft, phase: Phase, until: float | None) -> None:
    """Nobody plays in this phase; it lasts until the timer is at `until` s, or for good."""
    state = draft.state
    draft.state = state._replace(
        phase=phase,
        side=None,
        spot=None,
        running=False,
        pending=None,
        set_piece=None,
        proposal=None,
        participation=discipline.for_new_stoppage(state.participation),
        timing=state.timing.restart_timer(until, runs=False),
    )


def end_match(draft: RulingDraft, rule: str, text: str) -> None:
    """Full time."""
    suspend_play(draft, Phase.FULL_TIME, None)
    draft.add_event(EventKind.FULL_TIME, rule, text, score=draft.state.score)


def end_if_forfeited(draft: RulingDraft) -> bool:
    """End the match if a side cannot field as many robots as the rule book asks for; whether it was ended.

    Of two such sides the one with fewer robots forfeits; where both have as few, neither has won.
    """
    least = draft.book.people.least_robots
    fielded = {side: discipline.count_playable(draft, side) for side in Side}
    if min(fielded.values()) >= least:
        return False
    if fielded[Side.CYAN] == fielded[Side.MAGENTA]:
        end_match(draft, RULE, f"full time, neither side can field {least} robots")
    else:
        _forfeit(draft, min(fielded, key=lambda side: fielded[side]))
    return True


def _forfeit(draft: RulingDraft, loser: Side) -> None:
    """End the match: won by the other side, by as many goals as the rule book says at least."""
    state, winner = draft.state, loser.opponent
    goals = max(0, state.score.of(loser) + draft.book.people.forfeit_goals - state.score.of(winner))
    draft.state = state._replace(score=state.score.plus(winner, goals))
    left, least = discipline.count_playable(draft, loser), draft.book.people.least_robots
    draft.add_event(
        EventKind.FORFEIT,
        RULE,
        f"{loser} forfeits: it can field {left} robots, {least} are asked",
        side=loser,
        score=draft.state.score,
        measured=left,
        limit=least,
        unit="robots",
    )
    end_match(draft, RULE, f"full time, {winner} wins by forfeit")
