"""The end of play: a break, full time, or a forfeit by a side that cannot field enough robots."""

from typing import Any

from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score
from sim_host.soccer.referee.game.restart import Restart
from sim_host.soccer.referee.procedures import advantage, discipline
from sim_host.soccer.referee.ruling_draft import RulingDraft

RULE = "periods"
"""The name of the rule in the events of a forfeit."""


def suspend_play(draft: RulingDraft, phase: Phase, until: float | None, pending: Restart | None = None) -> None:
    """Enter a phase without play; it lasts until the timer reaches `until` s, or for good.

    The game clock stands still in it, unless the game is only stopped, for the `pending` restart.
    """
    advantage.end(draft)
    discipline.show_owed_cards(draft)
    state = draft.state
    draft.state = state._replace(
        phase=phase,
        side=None,
        spot=None,
        running=False,
        pending=pending,
        set_piece=None,
        proposal=None,
        participation=discipline.for_new_stoppage(state.participation),
        timing=state.timing.restart_timer(until, runs=None if phase is Phase.STOPPED else False),
    )


def end_match(draft: RulingDraft, rule: str, text: str) -> None:
    """End the match at full time."""
    suspend_play(draft, Phase.FULL_TIME, None)
    draft.state = draft.state._replace(questions=())
    draft.add_event(EventKind.FULL_TIME, rule, text, score=draft.state.score)


def end_if_forfeited(draft: RulingDraft) -> bool:
    """End the match if a side cannot field as many robots as the rule book requires; returns whether it was ended.

    Of two such sides, the one with fewer robots forfeits; if both have equally few, neither has won.
    """
    least = draft.book.people.least_robots
    fielded = {side: discipline.count_playable(draft, side) for side in Side}
    if min(fielded.values()) >= least:
        return False
    if fielded[Side.CYAN] == fielded[Side.MAGENTA]:
        end_match(draft, RULE, f"full time, neither side can field {least} robots")
    else:
        loser = min(fielded, key=lambda side: fielded[side])
        left = fielded[loser]
        reason = f"it can field {left} robots, {least} required"
        forfeit(draft, loser, reason, measured=left, limit=least, unit="robots")
    return True


def forfeit(draft: RulingDraft, loser: Side, reason: str, **figures: Any) -> None:
    """End the match: the other side wins by the goals that the rule book sets to none, or keeps a greater lead."""
    state, winner, goals = draft.state, loser.opponent, draft.book.people.forfeit_goals
    if state.score.of(winner) - state.score.of(loser) < goals:
        draft.state = state._replace(score=Score().plus(winner, goals))
    draft.add_event(
        EventKind.FORFEIT, RULE, f"{loser} forfeits: {reason}", side=loser, score=draft.state.score, **figures
    )
    end_match(draft, RULE, f"full time, {winner} wins by forfeit")
