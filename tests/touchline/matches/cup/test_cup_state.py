"""The state of a cup is a function of how its matches ended."""

from hypothesis import given, settings
from hypothesis import strategies as st

from touchline.matches.cup.cup_config import CupConfig, FormatConfig, FormatKind, TeamEntry
from touchline.matches.cup.cup_state import CupState, Ended, MatchState, Slot, state_of
from touchline.matches.cup.match_result import MatchResult

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
    slots = state_of(cup, lambda _: None).due
    assert len({slot.seed(cup) for slot in slots}) == len(slots) == 45
    assert slots[0].seed(cup) == slots[0].seed(cup.model_copy(update={"title": "another"}))
    assert slots[0].seed(cup) != slots[0].seed(cup.model_copy(update={"seed": 2}))


def test_a_match_that_failed_is_not_due_again_and_leaves_the_cup_incomplete() -> None:
    cup = cup_of(FormatKind.ROUND_ROBIN)
    state = state_of(cup, lambda slot: Ended(None, reason="no disk") if slot.name == "league 2" else by_name(slot))
    assert state.due == []
    assert [one.slot.name for one in state.failed] == ["league 2"]
    assert not state.is_complete and state.winner is None
    assert sum(row.played for row in state.schedule.tables["league"]) == 28


def test_a_forfeit_is_a_result() -> None:
    cup = cup_of(FormatKind.KNOCK_OUT)

    def ended(slot: Slot) -> Ended:
        teams = slot.fixture.teams
        if "A" in teams:
            goals = (0, 3) if teams[0] == "A" else (3, 0)
            return Ended(MatchResult(teams, goals, forfeited_by="A"), reason="A did not start")
        return by_name(slot)

    state = state_of(cup, ended)
    assert state.is_complete and state.winner == "B"
    assert [one.slot.name for one in state.matches if one.state is MatchState.FORFEITED] == [
        "semi-final 1",
        "third place",
    ]


def test_files_of_matches_have_plain_and_different_names() -> None:
    slots = state_of(cup_of(FormatKind.GROUPS, 3), lambda _: None).due
    names = {slot.file_name for slot in slots}
    assert len(names) == len(slots) and all(name.isascii() and " " not in name for name in names)
