"""The schedule of a cup: all fixtures that follow from its format and the results so far."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache

from touchline.matches.cup.cup_config import CupConfig, FormatKind
from touchline.matches.cup.formats.groups import divided, seeded_from
from touchline.matches.cup.formats.knock_out import Bracket, Vacancy, knock_out
from touchline.matches.cup.formats.round_robin import round_robin
from touchline.matches.cup.formats.swiss import STAGE as SWISS
from touchline.matches.cup.formats.swiss import most_rounds, swiss
from touchline.matches.cup.match_result import Fixture, FixtureResult, scored
from touchline.matches.cup.standings import Standing
from touchline.matches.cup.tie_breaks import table, winner_of
from touchline.matches.statistics.estimates import LEVEL
from touchline.matches.statistics.ratings import Scored, rate

LEAGUE = "league"
Results = Mapping[str, FixtureResult]
"""Name of a fixture → its matches that are over."""
Teams = Collection[str]


@dataclass(slots=True)
class Schedule:
    """A cup as far as it is known."""

    fixtures: list[Fixture] = field(default_factory=list)
    tables: dict[str, list[Standing]] = field(default_factory=dict)
    """Stage → its table: `league`, `swiss`, or each group."""
    bracket: Bracket | None = None


def schedule_of(cup: CupConfig, results: Results, refused: Teams = ()) -> Schedule:
    """All fixtures, tables and the bracket of a cup with these results; teams that were refused play in none."""
    return _KINDS[cup.format.kind](cup, results, refused)


def _league(cup: CupConfig, results: Results, refused: Teams) -> Schedule:
    fixtures = _round_robin(cup, LEAGUE, cup.names, refused, _repeats(cup, results, refused))
    return Schedule(fixtures, {LEAGUE: table(cup.names, _of(fixtures, results), cup.ranking, refused=refused)})


def _round_robin(cup: CupConfig, stage: str, teams: Sequence[str], refused: Teams, repeats: int = 1) -> list[Fixture]:
    """The fixtures of a round robin but those of refused teams; others have the same names with and without these."""
    chosen = cup.format
    fixtures = round_robin(teams, stage, double=chosen.double, best_of=chosen.best_of, repeats=repeats)
    return [one for one in fixtures if not set(one.teams) & set(refused)]


def _repeats(cup: CupConfig, results: Results, refused: Teams) -> int:
    """How often the round robin is played: until its order is significant, or the budget does not suffice for more.

    Each look at the ratings could find a false order, so that each gets its share of the level.
    """
    names = [team for team in cup.names if team not in refused]
    if cup.until_significant is None or len(names) < 2:
        return 1
    once = _round_robin(cup, LEAGUE, cup.names, refused)
    most = max(1, cup.until_significant.budget // sum(one.best_of for one in once))
    for repeats in range(1, most):
        fixtures = _round_robin(cup, LEAGUE, cup.names, refused, repeats)
        played = _of(fixtures, results)
        if len(played) < len(fixtures) or not all(one.is_over for one in played):
            return repeats
        matches = scored(match for one in played for match in one.matches)
        if _is_significant(tuple(names), tuple(matches), look_level(most)):
            return repeats
    return most


@cache  # all earlier looks are asked for with each outcome
def _is_significant(names: tuple[str, ...], matches: tuple[Scored, ...], level: float) -> bool:
    return rate(names, matches, level).significant


def look_level(looks: int) -> float:
    """The level of each of so many tests of the ratings that all of them together have `LEVEL` (Bonferroni)."""
    return 1 - (1 - LEVEL) / looks


def _groups(cup: CupConfig, results: Results, refused: Teams) -> Schedule:
    chosen, schedule = cup.format, Schedule()
    groups = divided(cup.names, chosen.groups)
    for name, teams in groups.items():
        fixtures = _round_robin(cup, name, teams, refused)
        schedule.fixtures += fixtures
        schedule.tables[name] = table(teams, _of(fixtures, results), cup.ranking, refused=refused)
    played = _of(schedule.fixtures, results)
    if len(played) == len(schedule.fixtures) and all(one.is_over for one in played):
        advancing = [[row.team for row in rows[: chosen.advance]] for rows in schedule.tables.values()]
        _add_bracket(schedule, cup, seeded_from(advancing), results, played, refused)
    return schedule


def _knock_out(cup: CupConfig, results: Results, refused: Teams) -> Schedule:
    schedule = Schedule()
    _add_bracket(schedule, cup, cup.names, results, (), refused)
    return schedule


def _add_bracket(
    schedule: Schedule,
    cup: CupConfig,
    seeded: Sequence[str],
    results: Results,
    before: Sequence[FixtureResult],
    refused: Teams,
) -> None:
    """Add the knock-out; who would have met a team that was refused has a bye."""
    schedule.bracket = knock_out(
        [Vacancy.BYE if team in refused else team for team in seeded],
        results,
        lambda result, earlier: winner_of(result, list(earlier), cup.ranking),
        best_of=cup.format.knock_out_matches,
        third_place=cup.format.third_place,
        before=before,
    )
    schedule.fixtures += schedule.bracket.fixtures


def _swiss(cup: CupConfig, results: Results, refused: Teams) -> Schedule:
    names = [team for team in cup.names if team not in refused]
    most = most_rounds(len(names))
    known = swiss(
        names,
        min(cup.format.rounds or most, most),
        results,
        lambda played, byes: [row.team for row in table(names, played, cup.ranking, byes)],
        best_of=cup.format.best_of,
    )
    rows = table(cup.names, _of(known.fixtures, results), cup.ranking, known.byes, refused)
    return Schedule(known.fixtures, {SWISS: rows})


def _of(fixtures: Sequence[Fixture], results: Results) -> list[FixtureResult]:
    return [results[one.name] for one in fixtures if one.name in results]


_KINDS = {
    FormatKind.ROUND_ROBIN: _league,
    FormatKind.GROUPS: _groups,
    FormatKind.KNOCK_OUT: _knock_out,
    FormatKind.SWISS: _swiss,
}
