"""The teams that ship know the rules: by the league's own book they play on, with hardly a foul."""

from itertools import pairwise

import pytest

from schemas.config.match_config import MatchConfig
from schemas.soccer.game import EventKind
from touchline.play.play_match import MatchOutcome, play_match

PLAYED_S = 60.0


@pytest.fixture(scope="module")
def played() -> MatchOutcome:
    """A minute of play."""
    return play_match(MatchConfig(rules="msl", seed=29, duration=180.0), until=PLAYED_S)


def test_by_the_leagues_rules_the_shipped_teams_play_and_hardly_foul(played: MatchOutcome) -> None:
    """Dribbles of nine metres were usual before the teams let the ball go; on average it is one foul in 90 s."""
    kinds = [event.kind for event in played.events]
    fouls = [event for event in played.events if event.kind is EventKind.FOUL]
    handling = [event for event in fouls if event.rule in ("dribble_circle", "backward", "long_hold")]
    assert kinds.count(EventKind.FOUL) <= 2 and len(handling) <= 1
    assert kinds.count(EventKind.IN_PLAY) >= 3 and kinds.count(EventKind.STALL) <= 1


def test_the_ball_is_in_play_for_most_of_the_running_clock(played: MatchOutcome) -> None:
    """In whole matches for two thirds of it, as `benchmarks/bench_referee.py` measures."""
    turns = [event for event in played.events if event.kind in (EventKind.IN_PLAY, EventKind.STOP, EventKind.START)]
    begun, end = turns[0].time, turns[-1].time
    in_play = sum(then.time - now.time for now, then in pairwise(turns) if now.kind is EventKind.IN_PLAY)
    assert turns[0].kind is EventKind.START and in_play > 0.5 * (end - begun)


def test_no_kick_off_ends_over_the_touch_line(played: MatchOutcome) -> None:
    """Both teams play a kick-off to a robot that reaches it."""
    restarts = [event for event in played.events if event.kind is EventKind.RESTART]
    after = [then for now, then in pairwise(restarts) if "kick-off" in now.text and then.time - now.time < 10.0]
    assert not [event for event in after if "throw-in" in event.text]
