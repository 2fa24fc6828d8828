import math
import sys

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.patches import Rectangle

from recordings.picture import draw, trace
from recordings.picture.bodies import COLOURS, draw_bodies, jumps
from recordings.picture.picture_data import PictureData
from recordings.picture.readings import draw_readings
from schemas.config.match_config import load_match
from schemas.config.obstacle import Shape
from schemas.config.profile import load_profile
from schemas.config.sensors.compass import Compass, CompassReading
from schemas.config.sensors.contact import Bumper, ContactReading
from schemas.config.sensors.range import RangeFinder, RangeReading
from schemas.config.soccer.rule_book import load_rule_book
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.messages.world import ObstacleTruth
from schemas.side import Side
from schemas.soccer.game import Phase, Score


def share_of(path, colour: str) -> float:
    """Share of the picture's pixels that have exactly this colour."""
    wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    pixels = np.round(imread(path)[..., :3] * 255).astype(int)
    return float(np.mean(np.all(np.abs(pixels - wanted) <= 1, axis=-1)))


@pytest.mark.parametrize("times", [None, [0.5, 1.0, 3.9]])
def test_a_match_is_drawn_with_the_robots_of_both_sides(recorded, tmp_path, times):
    out = tmp_path / "new" / "match.png"
    draw(recorded.path, out, times)
    for side in Side:
        assert share_of(out, COLOURS[side]) > 0.001


def test_obstacles_and_frames_are_drawn(recorded):
    """At their true place: a crate of 2 m by 1 m, turned, and the frame of one robot that has one."""
    data = PictureData(recorded.path)
    config = load_match(None, {"teams.cyan.types": {"cyan1": "keeper"}})
    setup = Setup.of(config, load_profile("msl"), load_rule_book("msl"))
    crate = ObstacleTruth(x=3.0, y=-2.0, heading=0.5, radius=1.12, height=0.5, shape=Shape.BOX, size_x=2.0, size_y=1.0)
    world = data.panel_data(1.0).now.replace(obstacles={"crate": crate})
    axes = Figure().subplots()
    draw_bodies(axes, setup, [world], 0.3)
    boxes = [patch for patch in axes.patches if isinstance(patch, Rectangle)]
    assert [(box.get_width(), box.get_height()) for box in boxes] == [
        (2.0, 1.0),
        pytest.approx((1.9 * 0.08, 1.9 * 0.6)),
    ]
    assert boxes[0].get_center() == pytest.approx((3.0, -2.0))


def test_more_panels_make_a_sheet_of_more_rows(recorded, tmp_path):
    heights = []
    for count in (2, 4):
        out = tmp_path / f"{count}.png"
        draw(recorded.path, out, [0.5 + 0.5 * number for number in range(count)])
        heights.append(imread(out).shape[0])
    assert heights[1] > 1.5 * heights[0]


def test_the_way_of_the_ball_is_drawn_over_the_whole_match(recorded, tmp_path):
    out = tmp_path / "trace.png"
    trace(recorded.path, out)
    draw(recorded.path, tmp_path / "match.png")
    picture, without = imread(out), imread(tmp_path / "match.png")
    red = [np.mean((pixels[..., 0] > 0.9) & (pixels[..., 2] < 0.4)) for pixels in (picture, without)]
    assert red[0] > 10 * red[1] > 0


@pytest.mark.parametrize(("times", "score"), [([1.0], "0 : 0"), ([1.0, 3.98], "1 : 0"), (None, "1 : 0")])
def test_a_picture_is_headed_by_the_teams_and_the_score(recorded, tmp_path, times, score):
    """Moments, with the score of the last one, and the way of the ball, with that of the end."""
    path = tmp_path / "match.svg"
    with matplotlib.rc_context({"svg.fonttype": "none"}):
        if times is None:
            trace(recorded.path, path)
        else:
            draw(recorded.path, path, times)
    assert all(f">{words}<" in path.read_text() for words in ("Team cyan", "Team magenta", score))


@pytest.mark.parametrize("time", [-1.0, 100.0])
def test_a_time_outside_the_recording_is_named_with_what_it_holds(recorded, tmp_path, time):
    with pytest.raises(TouchlineError, match=r"no world at .* it has 0 to 3\.98 s"):
        draw(recorded.path, tmp_path / "match.png", [time])


def test_a_picture_of_another_kind_is_refused(recorded, tmp_path):
    with pytest.raises(TouchlineError, match=r"\.png or \.svg"):
        draw(recorded.path, tmp_path / "match.bmp")


def test_without_matplotlib_the_pip_line_is_named(recorded, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(TouchlineError, match=r"pip install 'touchline\[viz\]'"):
        draw(recorded.path, tmp_path / "match.png")


def test_drawing_is_not_imported_before_somebody_draws():
    import subprocess

    code = "import recordings.picture, recordings.reading.recording, sys; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_panel_shows_the_trails_of_the_last_seconds_and_what_was_played(recorded):
    panel_data = PictureData(recorded.path).panel_data(3.5)
    assert (panel_data.worlds[0].tick, panel_data.now.tick) == (25, 175)
    assert panel_data.caption == "0:03   play"
    assert panel_data.score == Score()


def test_a_restart_is_named_with_its_side(rig):
    rig.play(range(10))
    rig.host.referee(10, Phase.THROW_IN, Score(), Side.MAGENTA)
    rig.play(range(10, 20))
    rig.leave()
    assert PictureData(rig.path).panel_data(0.3).caption == "0:00   throw-in, magenta"


def test_a_match_that_was_never_in_play_is_drawn_at_its_end(rig):
    rig.host.referee(0, Phase.KICK_OFF, Score(), Side.CYAN)
    rig.play(range(20))
    rig.leave()
    data = PictureData(rig.path)
    assert data.last_play() == data.end == pytest.approx(0.38)


def test_only_play_counts_for_the_way_of_the_ball(rig):
    rig.host.referee(0, Phase.KICK_OFF, Score(), Side.CYAN)
    rig.play(range(20))
    rig.host.referee(20, Phase.PLAY, Score())
    rig.play(range(20, 50))
    rig.host.referee(50, Phase.STOPPED, Score())
    rig.play(range(50, 70))
    rig.leave()
    assert [world.tick for world in PictureData(rig.path).in_play()] == list(range(20, 50))


def test_a_goal_is_known_with_its_time_and_place(recorded):
    (goal,) = PictureData(recorded.path).goals
    ball = next(world.ball for _, world in recorded.decoded("world", start=2.0))
    assert (goal.time, goal.x, goal.y) == (2.0, ball.x, ball.y)


def test_a_body_that_was_set_down_elsewhere_leaves_no_trail():
    assert jumps((0.0, 0.0), (3.0, 0.0))
    assert not jumps((0.0, 0.0), (0.4, 0.4))


def test_the_readings_of_sensors_are_drawn_where_they_were_taken(recorded):
    """Beams end at what they met, an arc is at the touched side, and a needle points along the measured heading."""
    data = PictureData(recorded.path)
    front = RangeFinder(beams=2, span=1.0, max_distance=5.0, x=0.1)
    setup = data.setup.replace(sensors={"standard": {"front": front, "north": Compass(), "bumper": Bumper(sectors=4)}})
    world = data.panel_data(1.0).now
    readings = {
        "front": RangeReading(age=0.0, angle_min=-0.25, angle_increment=0.5, distances=[None, 2.0]),
        "north": CompassReading(age=0.0, heading=math.pi / 2),
        "bumper": ContactReading(age=0.0, touched=[False, True, False, False]),
    }
    own = world.robots["cyan2"].replace(x=1.0, y=2.0, heading=math.pi)
    told = world.replace(robots={**world.robots, "cyan2": own}, sensors={"cyan2": readings})
    axes = Figure().subplots()
    draw_readings(axes, setup, [told, world], 0.3)
    beams, needle, arcs = (drawn.get_segments() for drawn in axes.collections)
    assert beams[0].tolist() == [
        pytest.approx((0.9, 2.0)),
        pytest.approx((0.9 - 2.0 * math.cos(0.25), 2.0 - 2.0 * math.sin(0.25))),
    ]
    assert needle[0][1][0] == pytest.approx(1.0) and needle[0][1][1] > 2.5
    assert len(arcs) == 1 and arcs[0].mean(axis=0)[1] < 2.0, "the left of a robot that looks to −x is at −y"
