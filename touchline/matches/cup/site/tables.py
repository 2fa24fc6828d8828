"""Table, cross table and ratings of a cup as HTML."""

from collections.abc import Sequence
from html import escape
from itertools import pairwise

from touchline.matches.cup.cup_state import CupMatch
from touchline.matches.cup.ratings import Rating, Ratings
from touchline.matches.cup.site.links import score_link, team_link
from touchline.matches.cup.site.markup import table
from touchline.matches.cup.standings import Standing

_HEADINGS = ("", "team", "P", "W", "D", "L", "goals", "±", "points")
_TITLES = ("place", "", "played", "won", "drawn", "lost", "goals for and against", "goal difference", "")


def standings(rows: Sequence[Standing]) -> str:
    """The table of a league, a group or a Swiss tournament, with what decided between teams of as many points."""
    cells = [
        (
            str(row.place),
            team_link(row.team) + _bye(row),
            *map(str, (row.played, row.won, row.drawn, row.lost)),
            f"{row.goals_for} : {row.goals_against}",
            signed(row.goal_difference),
            f"<b>{row.points}</b>",
        )
        for row in rows
    ]
    decided = [
        f"{escape(row.team)} before {escape(below.team)} by {escape(row.decided_by)}"
        for row, below in pairwise(rows)
        if row.decided_by is not None and row.played and below.played
    ]
    note = f'<p class="quiet">{"; ".join(decided)}.</p>' if decided else ""
    return table(_HEADINGS, cells, "standings", _TITLES) + note


def cross_table(rows: Sequence[Standing], matches: Sequence[CupMatch]) -> str:
    """The scores of each team (row) against each other one (column), the row's goals first."""
    teams = [row.team for row in rows]
    cells = []
    for team in teams:
        row = [team_link(team)]
        for other in teams:
            met = [one for one in matches if {team, other} == set(one.slot.fixture.teams)]
            row.append("<br>".join(score_link(one, of=team) for one in met) if team != other else "·")
        cells.append(row)
    return table(("", *(str(place) for place in range(1, len(teams) + 1))), cells, "cross", ("", *teams))


def ratings(rated: Ratings) -> str:
    """Ratings with intervals, as a drawing and as numbers, and whether the order is significant."""
    lowest, highest = min(one.low for one in rated.teams), max(one.high for one in rated.teams)
    cells = [
        (
            team_link(one.team),
            f"<b>{signed(one.value)}</b>",
            f"{signed(one.low)} to {signed(one.high)}",
            _bar(one, lowest, highest),
        )
        for one in rated.teams
    ]
    clear = [
        f"{escape(one.stronger)} is stronger than {escape(one.weaker)} (p = {one.p:.3f})"
        for one in rated.order
        if one.significant
    ]
    open_pairs = [f"{escape(one.stronger)} and {escape(one.weaker)}" for one in rated.order if not one.significant]
    sentences = ["The whole order is significant."] if rated.significant else []
    sentences += [f"{'; '.join(clear)}."] if clear else []
    sentences += [f"These matches do not show which is stronger: {'; '.join(open_pairs)}."] if open_pairs else []
    about = (
        "Bradley–Terry with draws, in Elo points from the mean of all teams, with intervals of 95 %. A shoot-out "
        "counts as a draw, a forfeit not at all."
    )
    return (
        table(("team", "rating", "interval", ""), cells, "ratings")
        + f'<p>{" ".join(sentences)}</p><p class="quiet">{about}</p>'
    )


def signed(value: float) -> str:
    """A whole number with its sign; 0 has none."""
    whole = round(value)
    return f"+{whole}" if whole > 0 else f"−{-whole}" if whole < 0 else "0"


def _bye(row: Standing) -> str:
    return f' <span class="quiet">{row.byes} bye{"s" if row.byes > 1 else ""}</span>' if row.byes else ""


def _bar(one: Rating, lowest: float, highest: float) -> str:
    def x(value: float) -> str:
        return f"{2 + 96 * (value - lowest) / max(highest - lowest, 1.0):.1f}%"

    return (
        '<svg class="interval" aria-hidden="true">'
        f'<line class="zero" x1="{x(0)}" x2="{x(0)}" y1="0" y2="14"/>'
        f'<line class="range" x1="{x(one.low)}" x2="{x(one.high)}" y1="7" y2="7"/>'
        f'<circle cx="{x(one.value)}" cy="7" r="4"/></svg>'
    )
