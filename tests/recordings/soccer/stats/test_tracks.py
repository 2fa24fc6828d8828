"""What a page knows of a match's motion, and how large it is."""

import math
from array import array
from base64 import b64decode

import pytest
from pytest import approx

from recordings.soccer.stats.match_statistics import MatchStatistics
from recordings.soccer.stats.page import page
from recordings.soccer.stats.page.content import content_of
from recordings.soccer.stats.page.game_history import GameHistory
from recordings.soccer.stats.tracks import ABSENT, MAX_RATE, NO_HOLDER, Tracks, sample_rate
from schemas.config.match_config import MatchConfig
from schemas.side import Side
from schemas.soccer.game import Phase


def test_a_sample_is_the_world_at_its_time_to_a_centimetre(script) -> None:
    for number in range(20):
        script.ball = (0.123 * number, -0.05)
        script.held_by = "magenta1" if number > 10 else None
        script.places["cyan2"] = (-2.0, 3.0 + 0.1 * number)
        script.shot()
    tracks = script.history()[1]
    assert tracks.samples == 1 + 2.0 * MAX_RATE
    for sample in (0, 13, 26, 50):
        tick = int(sample / MAX_RATE / 0.1 + 0.5)  # the world that is nearest, or the one before
        world = script.match_ticks()[tick].world
        assert abs(tracks.ball_x[sample] / 100 - world.ball.x) <= 0.123 + 0.005
        assert tracks.holder[sample] in (NO_HOLDER, list(tracks.robots).index("magenta1"))
    assert tracks.ball_x[50] == 234 and tracks.ball_y[50] == -5
    assert tracks.robots["cyan2"].y[50] == 490
    assert tracks.holder[50] == 2 and tracks.holder[0] == NO_HOLDER


@pytest.mark.parametrize(
    ("heading", "sample"), [(0.0, 0), (math.pi / 2, 64), (-math.pi / 2, 192), (math.pi, 128), (-0.001, 0)]
)
def test_a_heading_is_a_byte_for_a_whole_turn_counterclockwise_from_the_x_axis(script, heading, sample) -> None:
    script.headings["cyan2"] = heading
    script.rest(3)
    tracks = script.history()[1]
    assert (tracks.robots["cyan2"].heading[-1], tracks.robots["cyan1"].heading[-1]) == (sample, 0)


def test_a_robot_that_is_not_there_is_away(script) -> None:
    script.rest(5)
    script.places["joker"] = (1.0, 1.0)
    script.rest(5)
    del script.places["joker"]
    script.rest(5)
    tracks = script.history()[1]
    xs = tracks.robots["joker"].x
    assert len(xs) == tracks.samples
    assert (xs[0], xs[len(xs) // 2], xs[-1]) == (ABSENT, 100, ABSENT)


def test_missing_ticks_stand_still_and_keep_the_time(script) -> None:
    script.rest(40)
    lost = {round(tick * 0.1 * 1e9) for tick in range(10, 30)}
    script.messages = [(time, message) for time, message in script.messages if time not in lost]
    assert script.history()[1].samples == 1 + 4.0 * MAX_RATE


def test_the_game_history_has_what_changed_and_when(script) -> None:
    script.rest(9)
    script.goal(Side.MAGENTA)
    script.rest(9)
    script.shot(phase=Phase.KICK_OFF, side=Side.CYAN)
    script.shot(phase=Phase.KICK_OFF)
    script.rest(3)
    history, content = script.history()[2], script.content()
    assert [(round(interval.time, 3), interval.phase, interval.score) for interval in history.intervals] == [
        (0.0, "play", (0, 0)),
        (1.0, "stopped", (0, 1)),
        (2.0, "kick_off", (0, 1)),
    ]
    assert history.clock == approx([0.0, 1.0, 2.0])
    assert [event["kind"] for event in content["events"]] == ["goal"]


def test_content_carries_the_tracks_as_bytes(script) -> None:
    script.rest(10)
    content = script.content()
    robot = content["robots"][1]
    xs = array("h", b64decode(robot["x"]))
    assert (robot["name"], robot["side"], robot["number"]) == ("cyan2", "cyan", "2")
    assert len(xs) == content["samples"] and set(xs) == {-200}


def test_half_an_hour_makes_a_page_below_six_megabytes_and_a_day_too(script) -> None:
    match_ticks = script.match_ticks()
    for robots in (10, 12, 40):
        assert sample_rate(1800.0, robots) >= 8.0
    assert sample_rate(60.0, 10) == MAX_RATE
    names = [f"{side}{number}" for side in Side for number in range(1, 6)]
    some = next(iter(match_ticks[0].world.robots.values()))
    world = match_ticks[0].world.replace(robots=dict.fromkeys(names, some))
    script.setup = script.setup.replace(
        teams={
            side: team.replace(robots=[name for name in names if name.startswith(side)])
            for side, team in script.setup.teams.items()
        }
    )
    for duration in (1800.0, 86400.0):
        tracks, history, statistics = (
            Tracks(script.setup, 0.0, duration),
            GameHistory(),
            MatchStatistics(script.setup, 0.0, duration),
        )
        step = 1 / tracks.rate
        for number in range(int(duration * tracks.rate) + 1):
            now = world.replace(time=number * step)
            tracks.update(type(match_ticks[0])(now, None, None, None, match_ticks[0].lineup))
        statistics.update(match_ticks[0])
        content = content_of(script.manifest, script.setup, statistics.figures(), tracks, history)
        assert len(page(content)) < 6e6


def test_the_page_names_profile_rule_book_pace_and_seed_of_the_match(script) -> None:
    script.rest(2)
    setup = script.setup
    profile, rules = f"msl (version {setup.profile_version})", f"friendly (version {setup.rules_version})"
    assert script.content()["about"] == [f"profile {profile}", f"rules {rules}", f"pace {setup.pace}"]
    script.manifest = script.manifest.replace(config=MatchConfig(seed=7))
    assert script.content()["about"][-1] == "seed 7"
