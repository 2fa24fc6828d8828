"""The first page of a cup: where it stands, tables, bracket, ratings, and all matches."""

from collections.abc import Sequence
from html import escape

from touchline.matches.cup.cup_state import CupMatch, CupState, MatchState
from touchline.matches.cup.ratings import Ratings
from touchline.matches.cup.site import tables
from touchline.matches.cup.site.bracket import bracket
from touchline.matches.cup.site.links import score_link, team_link
from touchline.matches.cup.site.markup import page, section, table
from touchline.matches.cup.standings import Standing


def index_page(state: CupState, rated: Ratings | None, *, running: bool) -> str:
    """The page; `rated` is None where ratings cannot be estimated."""
    cup, schedule = state.cup, state.schedule
    parts = [
        section(_heading(stage), tables.standings(rows) + _cross(rows, state, stage), _width(schedule.tables))
        for stage, rows in schedule.tables.items()
    ]
    if schedule.bracket is not None:
        parts.append(section("Knock-out", bracket(state, schedule.bracket), "wide"))
    if rated is not None and any(one.matches for one in rated.teams):
        parts.append(section("Ratings", tables.ratings(rated), "wide"))
    parts.append(section("Matches", match_table(state.matches), "wide"))
    parts.append(section("Teams", _teams(state), "wide"))
    body = (
        f"<header><h1>{escape(cup.title or cup.name)}</h1>\n{_progress(state, running=running)}</header>\n"
        f'<main class="parts">\n{"".join(parts)}</main>'
    )
    return page(cup.title or cup.name, body, running=running)


def match_table(matches: Sequence[CupMatch], up: str = "") -> str:
    """A row for each match: name, cyan's team, score, magenta's team, and why it was forfeited or failed."""
    rows = []
    for one in matches:
        cyan, magenta = one.slot.sides
        reason = one.ended.reason if one.ended is not None and one.ended.reason is not None else ""
        names = (team_link(cyan, up), score_link(one, up, of=cyan), team_link(magenta, up))
        rows.append((escape(one.slot.name), *names, escape(reason)))
    return table(("match", "cyan", "", "magenta", ""), rows, "matches")


def _heading(stage: str) -> str:
    return "Table" if stage in ("league", "swiss") else stage[:1].upper() + stage[1:]


def _width(all_tables: dict[str, list[Standing]]) -> str:
    return "wide" if len(all_tables) == 1 else ""


def _cross(rows: list[Standing], state: CupState, stage: str) -> str:
    matches = [one for one in state.matches if one.slot.fixture.stage == stage]
    return f'<h3 class="under">Every match</h3>{tables.cross_table(rows, matches)}'


def _progress(state: CupState, *, running: bool) -> str:
    over = sum(one.state is not MatchState.DUE for one in state.matches)
    total, winner = len(state.matches), state.winner
    words = f"{over} of {total} known matches are over"
    if winner is not None and not running:
        words = f"Winner: <b>{team_link(winner)}</b> after {total} matches"
    elif not running:
        words += "; the cup is not complete"
    failed = f"; {len(state.failed)} failed" if state.failed else ""
    share = 100 * over / max(total, 1)
    bar = f'<div class="progress"><div style="width:{share:.0f}%"></div></div>' if running else ""
    return f'<p class="lead">{words}{failed}.</p>{bar}'


def _teams(state: CupState) -> str:
    rows = []
    for team in state.cup.teams:
        program = team.brain or " ".join(team.command or team.stdio or [])
        rows.append((team_link(team.name), escape(team.version), escape(program)))
    return table(("team", "version", "program"), rows, "teams")
