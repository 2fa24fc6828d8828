"""What is drawn, read with Foxglove's own classes and compared with profile, setup and world."""

import math
from itertools import product
from pathlib import Path

import pytest
from foxglove_schemas_protobuf import FrameTransforms_pb2, LaserScan_pb2, Log_pb2, SceneUpdate_pb2

from recordings.viz.colours import BALL, MARK, PITCH, ROBOT, Colour
from recordings.viz.drawing import BALL as BALL_TOPIC
from recordings.viz.drawing import EVENTS, FIELD, GAME, REPEAT_NS, ROBOTS, TF, Drawing, schema_of
from runtime.bus.contract import ReceivedMessage
from schemas.config.match_config import load_match
from schemas.config.obstacle import Shape
from schemas.config.profile import load_profile
from schemas.config.roster import RosterEntry
from schemas.config.sensors.compass import CompassReading
from schemas.config.sensors.range import RangeReading
from schemas.config.soccer.rule_book import load_rule_book
from schemas.messages.applied import Applied
from schemas.messages.setup import Setup, TaskSetup
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import BallTruth, ObstacleTruth, PushedTruth, RobotTruth, World
from schemas.side import Side
from schemas.soccer.game import EventKind, OffField, Phase, Score
from schemas.topics import APPLIED, COMMAND, EVENT, STATE, WORLD
from schemas.wire.part import encode
from support.free_match import free_match

CLASSES = {TF: FrameTransforms_pb2.FrameTransforms, EVENTS: Log_pb2.Log}
TICK_NS = 20_000_000


def robot(x: float = 0.0, y: float = 0.0, heading: float = 0.0, **more) -> RobotTruth:
    return RobotTruth(x=x, y=y, z=0.4, heading=heading, vx=0, vy=0, omega=0, holding=False, **more)


def world(tick: int = 0, robots: dict | None = None, **more) -> World:
    ball = BallTruth(x=1.0, y=2.0, z=0.5, vx=0, vy=0, vz=0)
    return World(
        tick=tick, time=tick * 0.02, robots=robots or {"cyan1": robot(-3.0), "magenta1": robot(3.0)}, ball=ball, **more
    )


@pytest.fixture
def setup() -> Setup:
    return setup_of("msl")


def setup_of(profile: str, **more) -> Setup:
    match = load_match(None, {"profile": profile, "teams.cyan.name": "Water", "teams.magenta.name": "NuBot", **more})
    return Setup.of(match, load_profile(profile), load_rule_book("msl"))


class Board:
    """A drawing, and what came of it."""

    def __init__(self, setup: Setup) -> None:
        self.drawing = Drawing(setup)

    def take(self, message, topic=WORLD, ns: int | None = None) -> dict:
        """Topic → the messages that this one brought."""
        at = round(message.time * 1e9) if ns is None else ns
        out: dict = {}
        for name, payload in self.drawing.draw(ReceivedMessage(topic, topic.key, encode(message), None), at):
            out.setdefault(name, []).append(CLASSES.get(name, SceneUpdate_pb2.SceneUpdate).FromString(payload))
        return out

    def scene(self, name: str, message, topic=WORLD) -> dict:
        """The entities that this one brought on a topic, by name."""
        [update] = self.take(message, topic)[name]
        return {entity.id: entity for entity in update.entities}


@pytest.fixture
def board(setup) -> Board:
    return Board(setup)


def extent(cube) -> tuple[float, ...]:
    """Least and largest x, y, z of a box that is not turned."""
    at, size = cube.pose.position, cube.size
    return tuple(
        round(value, 9)
        for middle, whole in ((at.x, size.x), (at.y, size.y), (at.z, size.z))
        for value in (middle - whole / 2, middle + whole / 2)
    )


def colour_of(shape) -> Colour:
    return Colour(shape.color.r, shape.color.g, shape.color.b, shape.color.a)


@pytest.mark.parametrize("profile", ["msl", "paper"])
def test_lines_bound_the_pitch_of_the_profile_with_their_outer_edges(profile):
    pitch = load_profile(profile).field
    lines = Board(setup_of(profile)).scene(FIELD, world())["lines"].lines
    assert {line.thickness for line in lines} == {pitch.line_width}
    origins = {(line.pose.position.x, line.pose.position.y, line.pose.position.z) for line in lines}
    assert origins == {(0.0, 0.0, 0.0)}, "points are counted from the origin of the field"
    assert {line.pose.orientation.w for line in lines} == {1.0}
    half = pitch.line_width / 2
    outer = [(point.x, point.y) for point in lines[0].points]
    assert max(x for x, _ in outer) + half == pytest.approx(pitch.length / 2)
    assert max(y for _, y in outer) + half == pytest.approx(pitch.width / 2)
    assert lines[0].type == lines[2].type == 1, "a closed line"
    radii = {round(math.hypot(point.x, point.y), 6) for point in lines[2].points}
    assert radii == {round(pitch.centre_circle_radius - half, 6)}
    areas = sorted((abs(line.points[1].x) - half, 2 * (abs(line.points[1].y) + half)) for line in lines[3:7])
    expected = sorted(
        (pitch.goal_line - depth, width)
        for depth, width in (
            (pitch.penalty_area_depth, pitch.penalty_area_width),
            (pitch.goal_area_depth, pitch.goal_area_width),
        )
        for _ in range(2)
    )
    assert [pytest.approx(area) for area in areas] == expected


def test_corner_arcs_are_quarters_of_a_circle_on_the_pitch(board, setup):
    pitch = setup.pitch
    arcs = board.scene(FIELD, world())["lines"].lines[7:]
    corners = []
    for arc in arcs:
        for point in arc.points:
            assert abs(point.x) <= pitch.goal_line + 1e-9 and abs(point.y) <= pitch.touch_line + 1e-9
        first, last = arc.points[0], arc.points[-1]
        corner = math.copysign(pitch.goal_line, first.x), math.copysign(pitch.touch_line, first.y)
        distances = {round(math.dist(corner, (point.x, point.y)), 6) for point in arc.points}
        assert distances == {round(pitch.corner_arc_radius - pitch.line_width / 2, 6)}
        assert math.dist((first.x, first.y), (last.x, last.y)) == pytest.approx(distances.pop() * math.sqrt(2))
        corners.append(corner)
    assert sorted(corners) == sorted(
        product((-pitch.goal_line, pitch.goal_line), (-pitch.touch_line, pitch.touch_line))
    )


def test_goals_stand_behind_the_goal_lines_with_the_width_and_height_of_the_profile(board, setup):
    pitch = setup.pitch
    scene = board.scene(FIELD, world())
    for end, sign in (("+x", 1), ("-x", -1)):
        right, left, bar, back, *_ = scene[f"goal {end}"].cubes
        near, far = sorted((sign * pitch.goal_line, sign * (pitch.goal_line + pitch.post)))
        half, height = pitch.goal_width / 2, pitch.goal_height
        for post, (low, high) in ((right, (-half - pitch.post, -half)), (left, (half, half + pitch.post))):
            assert extent(post) == pytest.approx((near, far, low, high, 0.0, height + pitch.post))
        assert extent(bar)[4] == pytest.approx(height)
        assert back.pose.position.x == pytest.approx(sign * (pitch.goal_line + pitch.goal_depth))


def test_a_robot_is_drawn_with_its_true_hull_in_the_colour_of_its_side(board, setup):
    scene = board.scene(ROBOTS, world())
    for name, side in (("cyan1", Side.CYAN), ("magenta1", Side.MAGENTA)):
        entity = scene[name]
        hull = entity.cylinders[0]
        assert entity.frame_id == f"{name}/base_link"
        assert entity.frame_locked
        assert (hull.size.x, hull.size.y, hull.size.z) == (
            2 * setup.robot.radius,
            2 * setup.robot.radius,
            setup.robot.height,
        )
        assert (hull.bottom_scale, hull.top_scale) == (1.0, 1.0)
        assert colour_of(hull) == ROBOT[side]
        assert [text.text for text in entity.texts] == ["1 GK"]
        arrow = entity.arrows[0]
        assert (arrow.pose.orientation.z, arrow.pose.orientation.w) == (0.0, 1.0), "along the kick axis"
        facts = {pair.key: pair.value for pair in entity.metadata}
        assert facts["side"] == side.value
        assert facts["type"] == "standard"
        assert facts["team"] == setup.teams[side].name


def test_a_robot_of_another_type_has_the_body_of_its_type():
    def number(value: float) -> dict:
        return {"value": value, "unit": "m", "origin": "this test"}

    size = {"radius": 0.2, "frame_width": 0.5, "frame_depth": 0.1}
    types = {
        "teams.cyan.types": {"cyan2": "framed"},
        "types": {"framed": {"robot": {name: number(value) for name, value in size.items()}}},
    }
    setup = setup_of("msl", **types)
    entity = Board(setup).scene(ROBOTS, world(robots={"cyan2": robot()}))["cyan2"]
    assert entity.cylinders[0].size.x == 0.4
    assert extent(entity.cubes[0])[:4] == pytest.approx((0.1, 0.2, -0.25, 0.25))
    assert {pair.key: pair.value for pair in entity.metadata}["type"] == "framed"


@pytest.mark.parametrize(("tick_s", "rate"), [(0.02, 50), (0.021, 48), (0.005, 50)])
def test_transforms_come_with_every_tick_and_fifty_times_a_second_at_most(board, tick_s, rate):
    count = sum(
        len(board.take(world(), ns=round(tick * tick_s * 1e9)).get(TF, [])) for tick in range(round(1 / tick_s))
    )
    assert count == pytest.approx(rate, abs=1)


def test_what_stands_still_is_drawn_when_it_changes_and_every_five_seconds(board):
    drawn = [board.take(world(tick), ns=tick * TICK_NS) for tick in range(REPEAT_NS // TICK_NS + 1)]
    for topic in (FIELD, ROBOTS, BALL_TOPIC):
        assert [tick for tick, one in enumerate(drawn) if topic in one] == [0, REPEAT_NS // TICK_NS]


def test_a_robot_off_the_field_is_faded_and_labelled_with_the_reason(board):
    board.take(world())
    away = world(1, {"cyan1": robot(off_field=OffField.RED_CARD), "magenta1": robot()})
    entity = board.scene(ROBOTS, away)["cyan1"]
    assert entity.texts[0].text == "1 GK (red card)"
    assert entity.cylinders[0].color.a < 0.5
    back = board.scene(ROBOTS, world(2))["cyan1"]
    assert back.cylinders[0].color.a == 1.0


def test_a_robot_that_left_is_taken_away_in_every_scene_from_then_on(board):
    board.take(world())
    for ns in (TICK_NS, REPEAT_NS):
        [update] = board.take(world(1, {"cyan1": robot()}), ns=ns)[ROBOTS]
        assert [(deletion.type, deletion.id) for deletion in update.deletions] == [(0, "magenta1")]
        assert [entity.id for entity in update.entities] == ["cyan1"]


def test_a_robot_that_joins_has_the_side_that_the_roster_gives_it(board):
    entries = [RosterEntry(name="guest", side=Side.MAGENTA), RosterEntry(name="cyan1", side=Side.CYAN, keeper=True)]
    applied = Applied(tick=0, time=0.0, inputs={}, robots=entries, chain="00")
    assert board.take(applied, APPLIED) == {}
    scene = board.scene(ROBOTS, world(robots={"guest": robot(), "cyan1": robot(), "nobody": robot()}))
    assert colour_of(scene["guest"].cylinders[0]) == ROBOT[Side.MAGENTA]
    assert {pair.key: pair.value for pair in scene["nobody"].metadata}["side"] == "none"
    assert len({colour_of(one.cylinders[0]) for one in scene.values()}) == 3


def test_the_ball_has_its_true_size_and_its_holder_a_disc_below_it(board, setup):
    [update] = board.take(world())[BALL_TOPIC]
    scene = {entity.id: entity for entity in update.entities}
    assert scene["ball"].frame_id == "ball"
    assert scene["ball"].spheres[0].size.x == 2 * setup.ball.radius
    assert scene["shadow"].frame_id == "ball/ground"
    holder = board.scene(BALL_TOPIC, world(1, possession="magenta1"))["holder"]
    assert holder.frame_id == "magenta1/base_link"
    assert holder.cylinders[0].pose.position.z == pytest.approx(-setup.robot.height / 2, abs=0.05)
    [update] = board.take(world(2))[BALL_TOPIC]
    assert [deletion.id for deletion in update.deletions] == ["holder"]


def test_obstacles_stand_where_the_world_has_them(board):
    box = ObstacleTruth(
        x=1.0, y=2.0, heading=math.pi / 2, radius=0.6, height=0.8, shape=Shape.BOX, size_x=1.0, size_y=0.5
    )
    tree = ObstacleTruth(
        x=-1.0, y=0.0, heading=0.0, radius=0.3, height=2.0, shape=Shape.CYLINDER, size_x=0.6, size_y=0.6
    )
    scene = board.scene(FIELD, world(obstacles={"box": box, "tree": tree}))
    cube, trunk = scene["obstacle box"].cubes[0], scene["obstacle tree"].cylinders[0]
    assert (cube.size.x, cube.size.y, cube.size.z, cube.pose.position.z) == (1.0, 0.5, 0.8, 0.4)
    assert cube.pose.orientation.z == pytest.approx(math.sin(math.pi / 4))
    assert (trunk.size.x, trunk.size.z, trunk.pose.position.x) == (0.6, 2.0, -1.0)
    [update] = board.take(world(1))[FIELD]
    assert sorted(deletion.id for deletion in update.deletions) == ["obstacle box", "obstacle tree"]


def test_the_board_has_each_team_at_the_half_that_it_defends(board, setup):
    state = GameState(
        tick=0, time=0.0, phase=Phase.THROW_IN, side=Side.CYAN, clock=65.4, score=Score(cyan=2, magenta=1)
    )
    texts = {text.text: text for text in board.scene(GAME, state, topic=STATE)["board"].texts}
    assert set(texts) == {"Water", "NuBot", "2 : 1", "1:05  throw in cyan"}
    assert texts["Water"].pose.position.x == -texts["NuBot"].pose.position.x == -setup.pitch.length / 4
    beside = setup.pitch.touch_line + setup.pitch.border
    assert all(text.pose.position.y > beside and text.pose.position.z > 0.0 for text in texts.values())
    turned = board.scene(GAME, state.replace(cyan_attacks=-1), topic=STATE)["board"].texts
    places = {text.text: text.pose.position.x for text in turned}
    assert places["Water"] > 0 > places["NuBot"]
    assert "1 : 2" in places, "in the order of the names"
    scored = Board(setup.replace(task=TaskSetup(score="a:b", unit="s")))
    assert scored.scene(GAME, state.replace(value=6.74), topic=STATE)["board"].texts[1].text == "2 : 1, 6.74 s"


@pytest.mark.parametrize(("kind", "level"), [(EventKind.GOAL, 2), (EventKind.FOUL, 3), (EventKind.FORFEIT, 4)])
def test_an_event_is_a_line_of_the_log_as_grave_as_it_is(board, kind, level):
    event = GameEvent(tick=50, time=1.0, clock=1.0, kind=kind, rule="some_rule", text="what happened")
    [entry] = board.take(event, EVENT)[EVENTS]
    assert (entry.level, entry.message, entry.name) == (level, "what happened", kind.value)
    assert (entry.file, entry.line, entry.timestamp.ToNanoseconds()) == ("some_rule", 50, 1_000_000_000)


@pytest.mark.parametrize("topic", [WORLD, STATE, EVENT, APPLIED, COMMAND])
@pytest.mark.parametrize(
    "payload",
    [
        b"",
        b"{}",
        b"[1]",
        b"nonsense",
        b'{"robots":[],"ball":1}',
        b'{"robots":{"a":{"x":NaN,"y":0,"z":0,"heading":0}},"ball":{"x":0,"y":0,"z":0}}',
        b'{"robots":{"a":{"x":1e999,"y":0,"z":0,"heading":0}},"ball":{"x":0,"y":0,"z":0}}',
    ],
)
def test_of_a_payload_that_is_no_message_nothing_is_drawn(board, topic, payload):
    assert board.drawing.draw(ReceivedMessage(topic, topic.key, payload, None), 0) == []


def luminance(colour: Colour) -> float:
    """Relative luminance, WCAG 2.2."""
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in colour[:3]]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: Colour, other: Colour) -> float:
    light, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize(
    ("one", "other", "least"),
    [
        (ROBOT[Side.CYAN], ROBOT[Side.MAGENTA], 4.5),
        (ROBOT[Side.CYAN], PITCH, 2.0),
        (ROBOT[Side.MAGENTA], PITCH, 2.0),
        (BALL, PITCH, 1.8),
        (BALL, ROBOT[Side.MAGENTA], 3.0),
        (MARK[Side.CYAN], ROBOT[Side.CYAN], 4.5),
        (MARK[Side.MAGENTA], ROBOT[Side.MAGENTA], 4.5),
    ],
)
def test_colours_are_distinguishable_by_lightness_alone(one, other, least):
    assert contrast(one, other) >= least


def test_a_range_finder_is_a_laser_scan_in_the_frame_of_its_robot(tmp_path: Path) -> None:
    number = '{{ value = {}, unit = "{}", origin = "test" }}'
    numbers = {"beams": (3, "1"), "span": (1.5, "rad"), "max_distance": (8, "m"), "x": (0.2, "m"), "height": (0.3, "m")}
    tables = "\n".join(f"{name} = {number.format(*given)}" for name, given in numbers.items())
    profile = tmp_path / "sensing.toml"
    profile.write_text(f'extends = "msl"\n[robot.sensors.front]\nkind = "range"\n{tables}')
    reading = RangeReading(age=0.0, angle_min=-0.5, angle_increment=0.5, distances=[1.5, None, 2.25])
    compass = CompassReading(age=0.0, heading=1.0)
    drawing = Drawing(setup_of(str(profile)))
    told = world(5, sensors={"cyan1": {"front": reading, "north": compass}, "magenta1": {"other": reading}})
    drawn = drawing.draw(ReceivedMessage(WORLD, WORLD.key, encode(told), None), 7_500_000_000)
    [(topic, payload)] = [one for one in drawn if one.topic.startswith("/viz/range")]
    assert topic == "/viz/range/cyan1/front" and schema_of(topic) == "foxglove.LaserScan"
    scan = LaserScan_pb2.LaserScan.FromString(payload)
    assert (scan.frame_id, scan.timestamp.ToNanoseconds()) == ("cyan1/base_link", 7_500_000_000)
    assert (scan.start_angle, scan.end_angle, list(scan.ranges)) == (-0.5, 0.5, [1.5, math.inf, 2.25])
    at = scan.pose.position
    assert (at.x, at.y, at.z) == pytest.approx((0.2, 0.0, 0.3 - 0.4)) and scan.pose.orientation.w == 1.0


def test_of_a_free_game_floor_zones_and_score_are_drawn_and_the_box_moves_with_its_frame(tmp_path: Path) -> None:
    zones = [
        {"name": "dock", "place": [3.0, 0.0], "radius": 1.5},
        {"name": "lane", "place": [-2.0, 1.0], "size": [2.0, 1.0], "heading": 0.5},
    ]
    match = free_match(tmp_path, **{"task.unit": "m", "task.zones": zones})
    board = Board(Setup.of(match, load_profile("msl"), load_rule_book("msl")))
    size = {"radius": 0.3, "height": 0.4, "shape": Shape.BOX, "size_x": 0.6, "size_y": 0.5}
    box = ObstacleTruth(
        x=1.0, y=2.0, heading=1.0, pushed=PushedTruth(vx=1, vy=0, omega=0, mass=5, friction=0.3), **size
    )
    shelf = ObstacleTruth(x=-4.0, y=2.0, heading=0.0, **size)
    begun = World(tick=0, time=0.0, robots={"one": robot()}, ball=None, obstacles={"box": box, "shelf": shelf})
    drawn = board.take(begun)
    scene = {entity.id: entity for entity in drawn[FIELD][0].entities}
    assert set(scene) == {"ground", "boundary", "zone dock", "zone lane", "obstacle box", "obstacle shelf"}
    assert scene["zone dock"].cylinders[0].size.x == 3.0 and scene["zone dock"].texts[0].text == "dock"
    assert scene["zone lane"].cubes[0].pose.orientation.z == pytest.approx(math.sin(0.25))
    assert (scene["obstacle box"].frame_id, scene["obstacle shelf"].frame_id) == ("obstacle/box", "map")
    assert scene["obstacle box"].cubes[0].pose.position.x == 0.0
    assert luminance(colour_of(scene["obstacle box"].cubes[0])) > luminance(colour_of(scene["obstacle shelf"].cubes[0]))
    later = board.take(begun.replace(tick=1, time=0.02, obstacles={"box": box.replace(x=1.02), "shelf": shelf}))
    assert set(drawn) == {TF, FIELD, ROBOTS} and set(later) == {TF}
    frames = {one.child_frame_id: one for one in later[TF][0].transforms}
    assert set(frames) == {"one/base_link", "obstacle/box"}
    assert frames["obstacle/box"].translation.x == pytest.approx(1.02, abs=1e-4)
    assert frames["obstacle/box"].rotation.z == pytest.approx(math.sin(0.5), abs=1e-4)
    state = GameState(tick=0, time=0.0, phase=Phase.PLAY, clock=5.0, value=0.25)
    texts = board.scene(GAME, state, topic=STATE)["board"].texts
    assert [text.text for text in texts] == ["0:05  play", "0.25 m", match.team(Side.CYAN).name or "cyan"]
