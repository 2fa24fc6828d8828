"""Where the line of a shot ends: where the ball crossed the goal line, or where it was stopped."""

import pytest

from recordings.soccer.stats.kicks import KickOutcome, KickRecord
from recordings.soccer.stats.page.shot_lines import end_of_shot
from recordings.soccer.stats.tracks import Tracks
from schemas.side import Side
from support.messages import make_setup

HALF = 11.0


def tracked(*places: tuple[float, float]) -> Tracks:
    """A ball that is at these places, one after another."""
    tracks = Tracks(make_setup(), 0.0, 1.0)
    for x, y in places:
        tracks.ball_x.append(round(100 * x))
        tracks.ball_y.append(round(100 * y))
        tracks.holder.append(255)
    return tracks


def shot(tracks: Tracks, samples: int, outcome: KickOutcome) -> KickRecord:
    ended = samples / tracks.rate
    return KickRecord(0.0, 0.0, "cyan2", Side.CYAN, None, 9.0, 0.0, 8.0, outcome, ended=ended)


def test_the_line_of_a_goal_ends_where_the_ball_crossed_the_goal_line() -> None:
    tracks = tracked((9.8, 0.0), (10.6, 0.4), (11.4, 0.8), (11.5, 0.8), (0.0, 0.0))
    end = end_of_shot(shot(tracks, 2, KickOutcome.GOAL), tracks, HALF)
    assert end == pytest.approx((11.0, 0.6))


def test_the_line_of_a_shot_at_the_other_end_crosses_that_line() -> None:
    tracks = tracked((-9.8, 0.0), (-10.8, -1.0), (-11.2, -1.4))
    end = end_of_shot(shot(tracks, 2, KickOutcome.MISSED), tracks, HALF)
    assert end == pytest.approx((-11.0, -1.2))


def test_the_line_of_a_save_ends_where_the_ball_was_stopped() -> None:
    tracks = tracked((9.0, 0.0), (9.8, 0.1), (10.6, 0.2), (10.2, 0.2), (9.8, 0.2))
    end = end_of_shot(shot(tracks, 2, KickOutcome.SAVED), tracks, HALF)
    assert end == pytest.approx((10.6, 0.2))


def test_a_ball_that_is_set_down_elsewhere_ends_the_line() -> None:
    tracks = tracked((9.0, 0.0), (10.4, 0.2), (0.0, 0.0), (0.0, 0.0))
    end = end_of_shot(shot(tracks, 3, KickOutcome.GOAL), tracks, HALF)
    assert end == pytest.approx((10.4, 0.2))
