"""What a page knows of a match's motion, and how large it is."""

from array import array
from base64 import b64decode

from pytest import approx

from recordings.stats.measure import Measure
from recordings.stats.page import page
from recordings.stats.page.content import content_of
from recordings.stats.page.course import Course
from recordings.stats.track import AWAY, FASTEST, NOBODY, Tracks, sample_rate
from schemas.game import Phase
from schemas.side import Side


def test_a_sample_is_the_world_at_its_time_to_a_centimetre(film) -> None:
    for number in range(20):
        film.ball = (0.123 * number, -0.05)
        film.held_by = "magenta1" if number > 10 else None
        film.places["cyan2"] = (-2.0, 3.0 + 0.1 * number)
        film.shot()
    tracks = film.course()[1]
    assert tracks.samples == 1 + 2.0 * FASTEST
    for sample in (0, 13, 26, 50):
        tick = int(sample / FASTEST / 0.1 + 0.5)  # the world that is nearest, or the one before
        world = film.moments()[tick].world
        assert abs(tracks.ball_x[sample] / 100 - world.ball.x) <= 0.123 + 0.005
        assert tracks.holder[sample] in (NOBODY, list(tracks.robots).index("magenta1"))
    assert tracks.ball_x[50] == 234 and tracks.ball_y[50] == -5
    assert tracks.robots["cyan2"].y[50] == 490
    assert tracks.holder[50] == 2 and tracks.holder[0] == NOBODY


def test_a_robot_that_is_not_there_is_away(film) -> None:
    film.rest(5)
    film.places["joker"] = (1.0, 1.0)
    film.rest(5)
    del film.places["joker"]
    film.rest(5)
    tracks = film.course()[1]
    xs = tracks.robots["joker"].x
    assert len(xs) == tracks.samples
    assert (xs[0], xs[len(xs) // 2], xs[-1]) == (AWAY, 100, AWAY)


def test_missing_ticks_stand_still_and_keep_the_time(film) -> None:
    film.rest(40)
    lost = {round(tick * 0.1 * 1e9) for tick in range(10, 30)}
    film.messages = [(time, message) for time, message in film.messages if time not in lost]
    assert film.course()[1].samples == 1 + 4.0 * FASTEST


def test_the_course_says_what_changed_and_when(film) -> None:
    film.rest(9)
    film.goal(Side.MAGENTA)
    film.rest(9)
    film.shot(phase=Phase.KICK_OFF, side=Side.CYAN)
    film.shot(phase=Phase.KICK_OFF)
    film.rest(3)
    course, content = film.course()[2], film.content()
    assert [(round(leg.time, 3), leg.phase, leg.score) for leg in course.legs] == [
        (0.0, "play", (0, 0)),
        (1.0, "stopped", (0, 1)),
        (2.0, "kick_off", (0, 1)),
    ]
    assert course.clock == approx([0.0, 1.0, 2.0])
    assert [event["kind"] for event in content["events"]] == ["goal"]


def test_content_carries_the_tracks_as_bytes(film) -> None:
    film.rest(10)
    content = film.content()
    robot = content["robots"][1]
    xs = array("h", b64decode(robot["x"]))
    assert (robot["name"], robot["side"], robot["number"]) == ("cyan2", "cyan", "2")
    assert len(xs) == content["samples"] and set(xs) == {-200}


def test_half_an_hour_makes_a_page_below_six_megabytes_and_a_day_too(film) -> None:
    moments = film.moments()
    for robots in (10, 12, 40):
        assert sample_rate(1800.0, robots) >= 8.0
    assert sample_rate(60.0, 10) == FASTEST
    names = [f"{side}{number}" for side in Side for number in range(1, 6)]
    some = next(iter(moments[0].world.robots.values()))
    world = moments[0].world.model_copy(update={"robots": dict.fromkeys(names, some)})
    film.setup = film.setup.model_copy(
        update={
            "teams": {
                side: team.model_copy(update={"robots": [name for name in names if name.startswith(side)]})
                for side, team in film.setup.teams.items()
            }
        }
    )
    for duration in (1800.0, 86400.0):
        tracks, course, measure = Tracks(film.setup, 0.0, duration), Course(), Measure(film.setup, 0.0, duration)
        step = 1 / tracks.rate
        for number in range(int(duration * tracks.rate) + 1):
            now = world.model_copy(update={"time": number * step})
            tracks.take(type(moments[0])(now, None, None, None, moments[0].cast))
        measure.take(moments[0])
        content = content_of(film.manifest, film.setup, measure.figures(), tracks, course)
        assert len(page(content)) < 6e6
