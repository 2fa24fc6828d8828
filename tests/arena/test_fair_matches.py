"""The teams that ship know the rules: by the league's own book they play on, with hardly a foul."""

from arena.in_process import play
from schemas.game import EventKind
from schemas.match_config import MatchConfig


def test_by_the_leagues_rules_the_shipped_teams_play_and_hardly_foul():
    """A minute and a half of play; dribbles of nine metres were usual before the teams let the ball go."""
    played = play(MatchConfig(rules="msl", seed=21, duration=180.0), until=90.0)
    kinds = [event.kind for event in played.events]
    handling = [event for event in played.events if event.rule in ("dribble_circle", "backward", "long_hold")]
    assert kinds.count(EventKind.FOUL) <= 2 and len(handling) <= 1
    assert kinds.count(EventKind.IN_PLAY) >= 3 and kinds.count(EventKind.STALL) <= 1
