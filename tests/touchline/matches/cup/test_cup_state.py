"""The state of a cup is a function of how its matches ended."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from schemas.side import Side
from schemas.soccer.game import Card
from touchline.matches.cup.cup_config import CupConfig, FormatConfig, FormatKind, SignificanceConfig, TeamEntry
from touchline.matches.cup.cup_plan import CupPlan
from touchline.matches.cup.cup_state import CupState, Ended, MatchState, Slot, state_of
from touchline.matches.cup.match_result import Fixture, MatchResult
from touchline.matches.cup.report import report_text
from touchline.matches.engine.outcome import Failed, FailureKind, Played

TEAMS = [TeamEntry(name=name, brain="simple") for name in "ABCDEF"]


def cup_of(kind: FormatKind, best_of: int = 1) -> CupConfig:
    return CupConfig(teams=TEAMS, format=FormatConfig(kind=kind, best_of=best_of))


def by_name(slot: Slot) -> Ended:
    """The team whose letter is first wins by two."""
    teams = slot.fixture.teams
    return Ended(MatchResult(teams, (2, 0) if teams[0] < teams[1] else (0, 2)))


def play(cup: CupConfig, order: st.DataObject | None = None) -> tuple[CupState, list[str]]:
    """Play the cup to its end, matches ending in any order; also the names of all that were played."""
    ended: dict[str, Ended] = {}
    while due := state_of(cup, lambda slot: ended.get(slot.name)).due:
        slot = due[0] if order is None else order.draw(st.sampled_from(due))
        assert slot.name not in ended
        ended[slot.name] = by_name(slot)
    return state_of(cup, lambda slot: ended.get(slot.name)), sorted(ended)


@settings(max_examples=15)
@given(st.data(), st.sampled_from(FormatKind), st.sampled_from([1, 3]))
def test_the_order_in_which_matches_end_changes_nothing(data: st.DataObject, kind: FormatKind, best_of: int) -> None:
    one, played = play(cup_of(kind, best_of))
    other, played_otherwise = play(cup_of(kind, best_of), data)
    assert one == other
    assert played == played_otherwise
    assert one.is_complete and one.winner == "A"


def test_each_match_has_a_seed_of_its_own_that_depends_on_its_name_and_the_seed_of_the_cup() -> None:
    cup = cup_of(FormatKind.ROUND_ROBIN, 3)
    slots = [one.slot for one in state_of(cup, lambda _: None).matches]
    assert len({slot.seed(cup) for slot in slots}) == len(slots) == 6 + 45
    assert slots[0].seed(cup) == slots[0].seed(cup.model_copy(update={"title": "another"}))
    assert slots[0].seed(cup) != slots[0].seed(cup.model_copy(update={"seed": 2}))


def test_a_match_that_failed_is_not_due_again_and_leaves_the_cup_incomplete() -> None:
    cup = cup_of(FormatKind.ROUND_ROBIN)
    state = state_of(cup, lambda slot: Ended(None, reason="no disk") if slot.name == "league 2" else by_name(slot))
    assert state.due == []
    assert [one.slot.name for one in state.failed] == ["league 2"]
    assert not state.is_complete and state.winner is None
    assert sum(row.played for row in state.schedule.tables["league"]) == 28


def refused(*teams: str) -> Callable[[Slot], Ended]:
    """These teams fail in their admission."""

    def ended(slot: Slot) -> Ended:
        culprits = tuple({*slot.fixture.teams} & {*teams})
        if not culprits:
            return by_name(slot)
        assert slot.is_admission, "a team that was refused plays no match"
        return Ended(MatchResult(slot.fixture.teams, (0, 0), forfeited_by=culprits), reason=f"{culprits[0]} crashed")

    return ended


def test_no_match_of_the_cup_is_due_before_all_teams_have_played_for_their_admission() -> None:
    cup = cup_of(FormatKind.ROUND_ROBIN)
    assert [slot.sides for slot in state_of(cup, lambda _: None).due] == [(name, name) for name in "ABCDEF"]
    all_but_one = state_of(cup, lambda slot: by_name(slot) if slot.is_admission and "F" not in slot.sides else None)
    assert [slot.name for slot in all_but_one.due] == ["admission 6"]


@pytest.mark.parametrize("kind", FormatKind)
@pytest.mark.parametrize("bad", ["A", "ABC", "ABDEF", "BCDEF"])
def test_a_team_that_was_refused_plays_nothing_gains_nothing_and_is_last(kind: FormatKind, bad: str) -> None:
    state = state_of(cup_of(kind), refused(*bad))
    assert state.is_complete and not state.due
    assert state.refused == set(bad)
    assert state.winner == min(set("ABCDEF") - set(bad))
    for rows in state.schedule.tables.values():
        gained = [(row.team in bad, row.points if row.team in bad else 0, row.played) for row in rows]
        assert [is_bad for is_bad, _, _ in gained] == sorted(is_bad for is_bad, _, _ in gained)
        assert all(points == 0 for _, points, _ in gained)


@pytest.mark.parametrize("kind", FormatKind)
def test_a_cup_in_which_no_team_was_admitted_is_over_and_has_no_winner(kind: FormatKind) -> None:
    state = state_of(cup_of(kind), refused(*"ABCDEF"))
    assert state.is_complete and state.winner is None
    assert "no team was admitted" in report_text(state)


def test_until_significant_leaves_out_who_was_refused() -> None:
    cup = CupConfig(teams=TEAMS, until_significant=SignificanceConfig(budget=40))
    assert len(state_of(cup, refused(*"ABCDE")).matches) == 6
    assert len(state_of(cup, refused(*"ABCD")).matches) < 6 + 40


def test_a_forfeit_is_a_result() -> None:
    cup = cup_of(FormatKind.KNOCK_OUT)

    def ended(slot: Slot) -> Ended:
        teams = slot.fixture.teams
        if "A" in teams and not slot.is_admission:
            goals = (0, 3) if teams[0] == "A" else (3, 0)
            return Ended(MatchResult(teams, goals, forfeited_by=("A",)), reason="A did not start")
        return by_name(slot)

    state = state_of(cup, ended)
    assert state.is_complete and state.winner == "B"
    assert [one.slot.name for one in state.matches if one.state is MatchState.FORFEITED] == [
        "semi-final 1",
        "third place",
    ]
    lines = report_text(state).splitlines()
    assert "final: D 0 : 2 B" in lines and "semi-final 1 forfeited: A did not start" in lines


def test_after_a_match_on_swapped_sides_goals_cards_and_a_forfeit_are_those_of_the_right_team() -> None:
    plan = CupPlan(cup_of(FormatKind.KNOCK_OUT), Path(), Path(), {})
    slot = Slot(Fixture("final", "final", 1, ("A", "B"), best_of=2), leg=1)  # B is in cyan
    sides = {
        Side.CYAN: SimpleNamespace(goals=2, shoot_out=3, cards={Card.YELLOW: 1}),
        Side.MAGENTA: SimpleNamespace(goals=0, shoot_out=4, cards={Card.RED: 1}),
    }
    played = Played("", SimpleNamespace(sides=sides), 60.0, "chain")
    assert plan.ended(slot, played).result == MatchResult(("A", "B"), (0, 2), (4, 3), yellows=(0, 1), reds=(1, 0))
    crashed = Failed("", FailureKind.CRASHED, "no ball", (Side.CYAN,))
    assert plan.ended(slot, crashed).result == MatchResult(("A", "B"), (3, 0), forfeited_by=("B",))


def test_a_cup_names_matches_that_depend_on_more_than_their_seeds() -> None:
    plan, cup = CupPlan(cup_of(FormatKind.ROUND_ROBIN), Path(), Path(), {}), cup_of(FormatKind.ROUND_ROBIN)
    sides = {side: SimpleNamespace(goals=1, shoot_out=0, cards={}) for side in Side}
    slow = Played("", SimpleNamespace(sides=sides), 60.0, "chain", missed={"cyan3": 7})
    state = state_of(cup, lambda slot: plan.ended(slot, slow if slot.name == "league 2" else replace(slow, missed={})))
    assert [one.slot.name for one in state.disturbed] == ["league 2"]
    sentence = "the match does not depend on its seed alone: sights without an answer: cyan3 7"
    assert f"league 2 played: {sentence}" in report_text(state)


def test_files_of_matches_have_plain_and_different_names() -> None:
    slots = [one.slot for one in state_of(cup_of(FormatKind.GROUPS, 3), lambda _: None).matches]
    names = {slot.file_name for slot in slots}
    assert len(names) == len(slots) and all(name.isascii() and " " not in name for name in names)
