"""Addresses of the pages of a cup, and how a match is named on them."""

import hashlib
import re
from html import escape

from touchline.matches.cup.cup_state import CupMatch, MatchState, Slot
from touchline.matches.cup.match_result import MatchResult
from touchline.matches.cup.site.markup import link


def match_address(slot: Slot) -> str:
    """The page of a match, from the folder of the cup."""
    return f"matches/{slot.file_name}.html"


def team_address(team: str) -> str:
    """The page of a team; names that differ in their signs only have different pages."""
    plain = re.sub(r"\W+", "_", team.lower(), flags=re.ASCII).strip("_")
    return f"teams/{plain or 'team'}_{hashlib.blake2b(team.encode(), digest_size=3).hexdigest()}.html"


def team_link(team: str, up: str = "") -> str:
    """A link to the page of a team."""
    return link(up + team_address(team), team)


def score_text(result: MatchResult, of: str | None = None) -> str:
    """The score as `2 : 1`, with penalties as `1 : 1 (4 : 3)`; `of` names the team whose goals come first."""
    turn = of is not None and result.teams[0] != of
    first, second = result.goals[::-1] if turn else result.goals
    text = f"{first} : {second}"
    if result.penalties is not None:
        penalties = result.penalties[::-1] if turn else result.penalties
        text += f" ({penalties[0]} : {penalties[1]})"
    return text


def score_link(match: CupMatch, up: str = "", of: str | None = None) -> str:
    """The score as a link to the page of the match; plain text while there is none."""
    if match.state is MatchState.DUE:
        return '<span class="quiet">– : –</span>'
    if match.result is None:
        return link(up + match_address(match.slot), "failed")
    text = link(up + match_address(match.slot), score_text(match.result, of))
    return f'{text}<span class="mark" title="forfeited">F</span>' if match.state is MatchState.FORFEITED else text


def plain(text: str) -> str:
    """Text as HTML."""
    return escape(text)
