"""The bracket of a knock-out as HTML: a column for each round, below each other on a phone."""

from html import escape

from touchline.matches.cup.cup_state import CupMatch, CupState, MatchState
from touchline.matches.cup.formats.knock_out import THIRD_PLACE, Bracket, Place, Vacancy, name_of, stage_of
from touchline.matches.cup.match_result import FixtureResult
from touchline.matches.cup.site.links import score_link, team_link


def bracket(state: CupState, known: Bracket) -> str:
    """The rounds from the first to the final, the match for third place, and the winner."""
    columns = []
    for number, pairs in enumerate(known.rounds):
        size = 2 * len(pairs)
        following = known.rounds[number + 1] if number + 1 < len(known.rounds) else [(known.winner, known.winner)]
        next_places = [place for pair in following for place in pair]
        boxes = [_box(state, pair, name_of(size, place), next_places[place]) for place, pair in enumerate(pairs)]
        if size == 2 and known.third_place is not None:
            third = known.third_place
            boxes += [f"<h3>{THIRD_PLACE}</h3>", _box(state, third.teams, third.name, known.third)]
        columns.append(f'<div class="round"><h3>{escape(stage_of(size))}</h3><div>{"".join(boxes)}</div></div>')
    return f'<div class="bracket">{"".join(columns)}</div>'


def _box(state: CupState, pair: tuple[Place, Place], name: str, winner: Place) -> str:
    result = state.fixtures.get(name)
    lines = "".join(_line(team, winner, result, place) for place, team in enumerate(pair))
    matches = [one for one in state.matches if one.slot.fixture.name == name]
    note = _note(matches, result, winner)
    return f'<div class="pair">{lines}{note}</div>'


def _line(team: Place, winner: Place, result: FixtureResult | None, place: int) -> str:
    if isinstance(team, Vacancy):
        text = "bye" if team is Vacancy.BYE else "?"
        return f'<div class="line quiet"><span>{text}</span></div>'
    score = ""
    if result is not None and result.matches:
        numbers = result.wins if result.fixture.best_of > 1 else result.goals
        score = str(numbers[place])
    kind = "line won" if team == winner else "line"
    return f'<div class="{kind}"><span>{team_link(team)}</span><span>{score}</span></div>'


def _note(matches: list[CupMatch], result: FixtureResult | None, winner: Place) -> str:
    """The scores of the matches, as links, and how a level fixture was decided."""
    scores = [score_link(one, of=one.slot.fixture.teams[0]) for one in matches if one.state is not MatchState.DUE]
    if result is not None and result.is_over and result.leader is None and not isinstance(winner, Vacancy):
        scores.append("by tie-break")
    return f'<div class="note quiet">{", ".join(scores)}</div>' if scores else ""
