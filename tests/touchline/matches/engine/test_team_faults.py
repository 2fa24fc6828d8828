"""Faults of teams that are read off the host's report on its clients."""

from collections.abc import Callable

from schemas.config.match_config import MatchConfig
from schemas.messages.health import AccountHealth, Health, RobotHealth
from schemas.side import Side
from sim_host.server.admission.account_limits import OVER_LIMIT
from touchline.matches.engine.outcome import FailureKind
from touchline.matches.engine.team_faults import fault_of

MatchOf = Callable[..., MatchConfig]


def health(missed: dict[str, int], dropped: dict[str, int] | None = None) -> Health:
    robots = {name: RobotHealth(alive=True, missed_in_a_row=count) for name, count in missed.items()}
    accounts = {"magenta": AccountHealth(dropped=dropped)} if dropped is not None else {}
    return Health(tick=1, time=0.02, pace="lockstep", real_time_factor=1.0, robots=robots, accounts=accounts)


def test_a_match_in_which_both_sides_answer_has_no_fault(match_of: MatchOf) -> None:
    assert fault_of(health({"cyan1": 0, "magenta1": 49}), match_of()) is None
    assert fault_of(None, match_of()) is None


def test_a_side_of_which_no_robot_answers_has_hung(match_of: MatchOf) -> None:
    config = match_of(**{"teams.magenta.size": 2})
    answering = health({"cyan1": 0, "magenta1": 900, "magenta2": 3})
    assert fault_of(answering, config) is None
    silent = health({"cyan1": 0, "magenta1": 900, "magenta2": 70})
    assert fault_of(silent, config) == (
        FailureKind.HUNG,
        (Side.MAGENTA,),
        "none of its robots has answered the last 70 sights",
    )


def test_where_neither_side_answers_both_have_hung(match_of: MatchOf) -> None:
    found = fault_of(health({"cyan1": 80, "magenta1": 900}), match_of())
    assert found is not None
    assert found[:2] == (FailureKind.HUNG, (Side.CYAN, Side.MAGENTA))


def test_dropped_messages_above_the_limits_break_the_access_rules(match_of: MatchOf) -> None:
    config = match_of()
    found = fault_of(health({"cyan1": 900, "magenta1": 0}, {OVER_LIMIT: 12}), config)
    assert found is not None
    kind, sides, reason = found
    assert (kind, sides) == (FailureKind.BROKE_ACCESS_RULES, (Side.MAGENTA,))
    assert reason == f"account magenta: 12 messages were dropped: {OVER_LIMIT}"
