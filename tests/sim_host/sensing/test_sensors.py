"""Sensors of a profile: range finders against marched beams, bumpers, compasses, and a kind that a test adds."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pytest
from numpy.typing import NDArray
from pytest import approx

from schemas.config.match_config import load_match
from schemas.config.quantity import Choice, Quantity
from schemas.config.sections import RobotBody
from schemas.config.sensors.table import KINDS, Reading, Sensor, SensorKind
from schemas.messages.command import Command, Drive
from schemas.messages.radio import Radio
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.messages.world import World
from schemas.wire.part import Part, encode
from schemas.wire.part_faults import validated
from sim_host.match.simulation import Simulation
from sim_host.sensing.sensors.carried import Carried
from sim_host.sensing.sensors.table import COMPUTED
from sim_host.snapshot import Snapshot

BOX = {"name": "crate", "shape": "box", "place": [-2.0, 1.0], "heading": 0.5, "size": [0.6, 0.9, 0.8]}
POST = {"name": "post", "shape": "cylinder", "place": [-5.0, -3.0], "radius": 0.3, "height": 1.0}


def sensor(name: str, kind: str, **numbers: tuple[Any, str] | str) -> str:
    """A table of a profile."""
    lines = [f"[robot.sensors.{name}]", f'kind = "{kind}"']
    for key, (value, unit) in numbers.items():
        lines.append(f'{key} = {{ value = {value}, unit = "{unit}", origin = "test" }}')
    return "\n".join(lines) + "\n"


FRONT = {"beams": (40, "1"), "span": (6.0, "rad"), "max_distance": (9.0, "m"), "x": (0.1, "m"), "heading": (0.4, "rad")}


@pytest.fixture
def play(tmp_path: Path) -> Iterator[Any]:
    """Make simulations of a profile with these tables."""
    made = []

    def make(tables: str, **overrides: object) -> Simulation:
        path = tmp_path / "sensing.toml"
        path.write_text('extends = "msl"\n' + tables)
        made.append(Simulation(load_match(None, {"profile": str(path), **overrides})))
        return made[-1]

    yield make
    for one in made:
        one.close()


def step(simulation: Simulation, ticks: int) -> None:
    for _ in range(ticks):
        tick, names = simulation.now.tick, simulation.roster.names
        simulation.step(
            {
                name: Command(answers_tick=tick, drive=Drive(vx=place % 5 - 2.0, vy=0.5, omega=1.0))
                for place, name in enumerate(names)
            }
        )


def sensed(simulation: Simulation, robot: str) -> dict[str, Any]:
    return Sight.decode(simulation.now.sights[robot]).sensors


def in_hull(body: RobotBody, at: NDArray[np.complex128]) -> NDArray[np.bool_]:
    """Whether points in a robot's frame are within its hull or its frame."""
    along = (body.radius - body.frame_depth <= at.real) & (at.real <= body.radius)
    return (abs(at) <= body.radius) | (along & (abs(at.imag) <= body.frame_width / 2))


def marched(simulation: Simulation, robot: str, bearing: float, reach: float, place: complex = 0.1) -> float | None:
    """Distance along a beam of the range finder, by steps of 1 mm, to the first point within something."""
    world = simulation.now.world
    own = world["robots"][robot]
    eye = complex(own["x"], own["y"]) + place * complex(math.cos(own["heading"]), math.sin(own["heading"]))
    way = complex(math.cos(own["heading"] + bearing), math.sin(own["heading"] + bearing))
    others = [
        (model.body, complex(one["x"], one["y"]), complex(math.cos(one["heading"]), math.sin(one["heading"])))
        for model, (name, one) in zip(simulation.roster.models, world["robots"].items(), strict=True)
        if name != robot
    ]
    pitch, turn = simulation.profile.field, complex(math.cos(-0.5), math.sin(-0.5))
    at = eye + way * np.arange(int(reach * 1000)) / 1000
    in_box = (at - complex(*BOX["place"])) * turn
    within = (
        (abs(at.real) >= pitch.goal_line + pitch.border)
        | (abs(at.imag) >= pitch.touch_line + pitch.border)
        | np.any([in_hull(body, (at - place) / turned) for body, place, turned in others], axis=0)
        | (abs(at - complex(*POST["place"])) <= POST["radius"])
        | ((abs(in_box.real) <= 0.3) & (abs(in_box.imag) <= 0.45))
    )
    return int(np.argmax(within)) / 1000 if within.any() else None


def test_each_beam_has_the_distance_of_the_first_body_on_it(play) -> None:
    wide = {"cyan1": "keeper", "cyan3": "keeper"}
    one = play(sensor("front", "range", **FRONT), obstacles=[BOX, POST], **{"teams.cyan.types": wide})
    step(one, 30)
    hits = 0
    for robot in one.roster.names[::3]:
        reading = sensed(one, robot)["front"]
        for beam in range(0, 40, 5):
            bearing = reading.angle_min + beam * reading.angle_increment
            expected = marched(one, robot, bearing, 9.0)
            assert reading.distances[beam] == (None if expected is None else approx(expected, abs=0.002)), (robot, beam)
            hits += expected is not None
    assert 10 < hits < 4 * 8


@pytest.mark.parametrize(
    ("beams", "span", "heading"),
    [(37, math.tau, 0.0), (24, math.tau, 2.0), (1, 0.0, -3.0), (1, 0.0, 3.1), (2, 6.2, 1.0), (4, 0.0, -3.0)],
)
def test_beams_all_round_and_single_ones_meet_bodies_at_the_seam_of_the_span(play, beams, span, heading) -> None:
    numbers = {"beams": (beams, "1"), "span": (span, "rad"), "heading": (heading, "rad"), "y": (-0.2, "m")}
    front = sensor("front", "range", max_distance=(9.0, "m"), **numbers)
    one = play(front, obstacles=[BOX, POST], **{"teams.cyan.types": {"cyan3": "keeper"}})
    step(one, 40)
    hits = 0
    for robot in one.roster.names:
        reading = sensed(one, robot)["front"]
        assert reading.angle_min == approx(heading + (span / beams - span) / 2)
        for beam in range(0, beams, 3):
            bearing = reading.angle_min + beam * reading.angle_increment
            expected = marched(one, robot, bearing, 9.0, place=-0.2j)
            assert reading.distances[beam] == (None if expected is None else approx(expected, abs=0.002)), (robot, beam)
            hits += expected is not None
    assert hits > 2


def test_beams_pass_over_what_is_lower_and_meet_the_slice_of_a_ball_at_their_height(play) -> None:
    common = {"span": (0.0, "rad"), "beams": (1, "1"), "max_distance": (30.0, "m")}
    wall = '[field]\nboundary_height = { value = 0.5, unit = "m", origin = "test" }\n'
    probe = play(wall)
    field, low, radius = probe.profile.field, 0.6, probe.profile.ball.radius
    one = play(
        wall
        + sensor("top", "range", **common, height=(field.boundary_height, "m"))
        + sensor("over", "range", **common, height=(field.boundary_height + 0.01, "m"))
        + sensor("crate", "range", **common, height=(low, "m"))
        + sensor("air", "range", **common, height=(low + 0.001, "m"))
        + sensor("ball", "range", **common, height=(radius + 0.05, "m"))
        + 'ball = { value = "seen", origin = "test" }\n'
        + sensor("low_ball", "range", **common, height=(2 * radius + 0.01, "m"))
        + 'ball = { value = "seen", origin = "test" }\n',
        obstacles=[{**BOX, "place": [8.0, -4.0], "heading": 0.0, "size": [0.6, 0.9, 0.6]}],
    )
    place = [
        {"body": "cyan2", "x": 3.0, "y": 5.2, "heading": 0.0},
        {"body": "cyan3", "x": 5.0, "y": -4.0, "heading": 0.0},
        {"body": "ball", "x": 4.0, "y": 5.2},
    ]
    assert one.handle_scene(validated(SceneRequest, {"operation": SceneOperation.PLACE, "place": place})).accepted
    one.step({})
    clear, boxed = sensed(one, "cyan2"), sensed(one, "cyan3")
    assert clear["top"].distances == [approx(field.goal_line + field.border - 3.0, abs=1e-3)]
    assert clear["over"].distances == [None]
    assert boxed["crate"].distances[0] == approx(8.0 - 0.3 - 5.0, abs=1e-3)
    assert boxed["air"].distances[0] != approx(8.0 - 0.3 - 5.0, abs=0.1)
    assert clear["ball"].distances == [approx(1.0 - math.sqrt(radius**2 - 0.05**2), abs=2e-3)]
    assert clear["low_ball"].distances == clear["top"].distances


def test_beams_have_noise_dropouts_and_a_rate_and_readings_grow_older(play) -> None:
    numbers = {**FRONT, "rate": (10, "Hz"), "max_distance": (100.0, "m")}
    exact, noisy = (
        play(sensor("front", "range", **numbers, **more))
        for more in ({}, {"noise": (0.05, "m"), "dropout": (0.2, "1")})
    )
    readings = [sensed(noisy, name)["front"] for name in noisy.roster.names]
    errors = [
        seen - true
        for name, reading in zip(noisy.roster.names, readings, strict=True)
        for seen, true in zip(reading.distances, sensed(exact, name)["front"].distances, strict=True)
        if seen is not None
    ]
    assert math.sqrt(sum(error**2 for error in errors) / len(errors)) == approx(0.05, rel=0.2)
    assert len(errors) == approx(0.8 * 400, rel=0.1)
    ages = []
    for _ in range(7):
        ages.append(sensed(noisy, "cyan1")["front"].age)
        step(noisy, 1)
    assert ages == approx([0.0, 0.02, 0.04, 0.06, 0.08, 0.0, 0.02])
    assert "sensors" in noisy.now.world or noisy.now.tick % 5
    again = play(sensor("front", "range", **numbers, noise=(0.05, "m"), dropout=(0.2, "1")))
    assert sensed(again, "cyan1")["front"] == readings[0], "the same seed gives the same noise"


def test_a_compass_shows_the_heading_in_the_field_frame_with_its_errors(play) -> None:
    one = play(
        sensor("north", "compass")
        + sensor("bent", "compass", bias=(0.5, "rad"), drift=(0.1, "rad"), noise=(0.01, "rad"))
    )
    step(one, 20)
    for name, robot in one.now.world["robots"].items():
        assert sensed(one, name)["north"].heading == approx(robot["heading"], abs=1e-4)
        error = sensed(one, name)["bent"].heading - robot["heading"]
        assert math.remainder(error - 0.5, math.tau) == approx(0.0, abs=0.5) and error != 0.5


def test_the_error_of_a_compass_wanders_from_knot_to_knot(play) -> None:
    one = play(sensor("bent", "compass", drift=(0.1, "rad"), drift_time=(0.2, "s")))
    errors: dict[str, list[float]] = {name: [] for name in one.roster.names}
    for _ in range(81):
        for name, robot in one.now.world["robots"].items():
            errors[name].append(math.remainder(sensed(one, name)["bent"].heading - robot["heading"], math.tau))
        step(one, 1)
    for error in errors.values():
        for knot in range(0, 80, 10):
            between = 0.5 * math.pi * 0.3  # three of ten ticks later
            expected = math.cos(between) * error[knot] + math.sin(between) * error[knot + 10]
            assert error[knot + 3] == approx(expected, abs=5e-4)
    at_knots = [error[knot] for error in errors.values() for knot in range(0, 81, 10)]
    assert math.sqrt(sum(error**2 for error in at_knots) / len(at_knots)) == approx(0.1, rel=0.25)


def test_a_bumper_feels_with_the_frame_of_its_hull_and_no_farther(play) -> None:
    one = play(
        sensor("bumper", "contact", sectors=(8, "1"), gap=(0.03, "m")),
        obstacles=[{**POST, "radius": 0.05}],
        **{"teams.cyan.types": {"cyan1": "keeper"}},
    )
    body = one.roster.models[0].body
    corner = math.atan2(body.frame_width / 2, body.radius)
    for bearing, gap, touched in (
        (corner, 0.01, [1]),
        (-corner, 0.01, [7]),
        (corner, 0.045, []),
        (corner + 0.3, 0.01, []),
        (math.pi - corner, 0.01, []),
        (math.pi, 0.01, []),
    ):
        away = math.hypot(body.radius, body.frame_width / 2) + 0.05 + gap
        x, y = -5.0 - away * math.cos(bearing), -3.0 - away * math.sin(bearing)
        place = [{"body": "cyan1", "x": x, "y": y, "heading": 0.0}]
        assert one.handle_scene(validated(SceneRequest, {"operation": SceneOperation.PLACE, "place": place})).accepted
        one.step({})
        felt = sensed(one, "cyan1")["bumper"].touched
        assert [number for number, is_touched in enumerate(felt) if is_touched] == touched, (bearing, gap)


def test_a_bumper_feels_robots_obstacles_and_the_boundary_in_their_sectors(play) -> None:
    one = play(sensor("bumper", "contact", sectors=(4, "1")), obstacles=[BOX, POST])
    reach = one.profile.robot.radius
    wall = one.profile.field.touch_line + one.profile.field.border
    places = {
        "cyan2": (-5.0 - 0.302 - reach, -3.0, 0.0),  # the post is in front
        "cyan3": (1.0, wall - reach - 0.001, 0.0),  # the boundary is to the left
        "cyan4": (4.0, 0.0, 1.0),  # nothing near
        "cyan5": (6.0, 2.0, 0.0),
        "magenta5": (6.0 - 2 * reach - 0.004, 2.0, 0.0),  # behind cyan5
    }
    place = [{"body": name, "x": x, "y": y, "heading": heading} for name, (x, y, heading) in places.items()]
    assert one.handle_scene(validated(SceneRequest, {"operation": SceneOperation.PLACE, "place": place})).accepted
    one.step({})
    assert sensed(one, "cyan2")["bumper"].touched == [True, False, False, False]
    assert sensed(one, "cyan3")["bumper"].touched == [False, True, False, False]
    assert sensed(one, "cyan4")["bumper"].touched == [False] * 4
    assert sensed(one, "cyan5")["bumper"].touched == [False, False, True, False]
    assert sensed(one, "magenta5")["bumper"].touched == [True, False, False, False]


def test_a_match_without_sensors_has_no_word_of_them(play) -> None:
    plain = play("")
    plain.step({})
    for payload in (plain.now.sights["cyan1"], encode(plain.now.world), plain.setup().encode()):
        assert b'"sensors"' not in payload
    world = World.decode(encode(plain.now.world))
    assert b'"sensors"' not in world.encode() and world.sensors == {}


def test_readings_and_numbers_survive_the_wire(play) -> None:
    one = play(sensor("front", "range", **FRONT) + sensor("north", "compass"))
    setup = Setup.decode(one.setup().encode())
    assert setup.sensors_of("cyan1") == one.profile.sensors_of("standard") == setup.sensors_of("magenta3")
    world = World.decode(encode(one.now.world))
    assert world.sensors["cyan1"] == sensed(one, "cyan1")
    assert World.decode(world.encode()) == world
    assert {"front", "north"} == set(world.sensors["magenta5"])
    payload = one.now.sights["cyan1"]
    assert Sight.decode(payload).encode() == payload, "programs that read lines get this"


def test_a_sight_is_the_same_whether_it_is_sent_or_read_later(play) -> None:
    one, other = (play(sensor("front", "range", **FRONT) + sensor("north", "compass")) for _ in range(2))
    sent: list[tuple[str, bytes]] = []
    ticks = []
    for tick in range(12):
        said = {
            name: Command(answers_tick=tick, radio=Radio(role=name, extra={"tick": tick})) for name in one.roster.names
        }
        one.step(said, send=lambda *sight: sent.append(sight))
        ticks.append(other.step(said).sights)
    assert list(one.now.sights.items()) == sent[-len(one.roster.names) :]
    perceived = [pair for sights in ticks for pair in sights.perceived.items()]
    assert perceived[-1][1].radio
    assert [(robot, Sight.decode(sight)) for robot, sight in sent] == perceived
    assert [pair for sights in ticks for pair in sights.items()] == sent


def test_the_fullest_world_is_within_its_limit(play) -> None:
    one = play(
        sensor("front", "range", **{**FRONT, "beams": (480, "1"), "max_distance": (200.0, "m")}),
        **{"teams.cyan.size": 11, "teams.magenta.size": 11, "rules": "eleven"},
    )
    assert World.decode(encode(one.now.world)).sensors.keys() == set(one.roster.names)


@dataclass(frozen=True, slots=True, kw_only=True)
class Odometer(Sensor):
    """A third party's sensor: all that is new about it stands in this file."""

    kind: Annotated[str, Choice("kind of the sensor", ("odometer",))] = "odometer"
    slip: Annotated[float, Quantity("1", "share of the distance that is not measured", 0, 1)] = 0.0
    rate: Annotated[float, Quantity("Hz", "readings per second", 0.1, 1000)] = 1000.0


class OdometerReading(Part, Reading, tag_field="kind", tag="odometer"):
    """A speed."""

    age: float
    speed: float


class ComputedOdometer:
    """Computes it."""

    def __init__(self, carried: Carried) -> None:
        self._carried = carried

    def read(self, snapshot: Snapshot, number: int) -> list[OdometerReading]:
        """A reading for each robot."""
        del number
        robots = [snapshot.robots[place] for place in self._carried.robots]
        share = 1.0 - self._carried.numbers.slip
        return [OdometerReading(age=0.0, speed=share * math.hypot(robot.vx, robot.vy)) for robot in robots]


def test_a_new_kind_is_one_file_and_a_section(play, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(KINDS, "odometer", SensorKind(Odometer, OdometerReading))
    monkeypatch.setitem(COMPUTED, "odometer", ComputedOdometer)
    one = play(sensor("wheel", "odometer", slip=(0.25, "1")))
    step(one, 20)
    robot = one.now.world["robots"]["cyan1"]
    assert sensed(one, "cyan1")["wheel"].speed == approx(0.75 * math.hypot(robot["vx"], robot["vy"])) != 0.0
    assert Setup.decode(one.setup().encode()).sensors_of("cyan1")["wheel"] == Odometer(slip=0.25)
    assert "OdometerReading" in str(World.json_schema())
