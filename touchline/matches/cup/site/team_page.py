"""The page of a team: what it is, how it stands, and its matches."""

from html import escape

from touchline.matches.cup.cup_config import TeamEntry
from touchline.matches.cup.cup_state import CupState
from touchline.matches.cup.ratings import Ratings
from touchline.matches.cup.site.index_page import match_table
from touchline.matches.cup.site.markup import page, section
from touchline.matches.cup.site.tables import signed


def team_page(state: CupState, team: TeamEntry, digest: str | None, rated: Ratings | None, *, running: bool) -> str:
    """The page; `digest` is that of its files."""
    program = team.brain or " ".join(team.command or team.stdio or [])
    facts = [("program", program), ("version", team.version), ("digest of its files", digest or "")]
    for stage, rows in state.schedule.tables.items():
        row = next((one for one in rows if one.team == team.name), None)
        if row is not None:
            facts.append((stage, f"place {row.place} of {len(rows)}, {row.points} points"))
    rating = next((one for one in rated.teams if one.team == team.name), None) if rated is not None else None
    if rating is not None and rating.matches:
        facts.append(("rating", f"{signed(rating.value)} ({signed(rating.low)} to {signed(rating.high)})"))
    listed = "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in facts if value)
    matches = [one for one in state.matches if team.name in one.slot.fixture.teams]
    body = (
        f"<header><h1>{escape(team.name)}</h1></header>\n<main>"
        + section("The team", f'<dl class="facts">{listed}</dl>')
        + section("Its matches", match_table(matches, "../"))
        + "</main>"
    )
    return page(team.name, body, up="../", running=running)
