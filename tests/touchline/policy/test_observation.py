"""What a robot observes: each entry is named, in its scale, in the body frame, and within its limits."""

import math

import numpy as np
import pytest

from robot_agent.sdk.contract import Briefing
from schemas.config.sensors.compass import CompassReading
from schemas.config.sensors.contact import ContactReading
from schemas.config.sensors.range import RangeReading
from schemas.messages.radio import Motion
from schemas.messages.sight import BallSight, Obstacle, ReceivedRadio, Sight
from touchline.play.play_match import InProcessMatch
from touchline.policy.observation import Observation


def observed(
    match: InProcessMatch, robot: str, zone: tuple[float, float] | None = None, **changes: object
) -> dict[str, float]:
    """Name → number of what a robot observes, with the task's first zone there; `changes` are of its sight."""
    setup = match.simulation.setup()
    if zone is not None:
        assert setup.task is not None
        moved = setup.task.zones[0].model_copy(update={"place": zone})
        setup = setup.replace(task=setup.task.replace(zones=[moved]))
    layout = Observation(Briefing.of(robot, setup))
    sight: Sight = match.simulation.now.sights.perceived[robot].replace(**changes)
    made = layout.observe(sight)
    assert made.dtype == np.float32 and made.shape == (len(layout.names),)
    assert (layout.low <= made).all() and (made <= layout.high).all()
    return dict(zip(layout.names, made.tolist(), strict=True))


def test_a_robot_observes_zones_and_bodies_from_where_it_stands(rovers: InProcessMatch) -> None:
    seen = observed(rovers, "one")  # it looks along +y
    assert (seen["zone.dock.x"], seen["zone.dock.y"]) == (pytest.approx(0.2, abs=1e-4), pytest.approx(-0.8, abs=1e-4))
    assert (seen["me.cos"], seen["me.sin"]) == (pytest.approx(0.0, abs=1e-4), pytest.approx(1.0))
    assert seen["obstacle1.seen"] == 1.0 and seen["obstacle1.x"] == pytest.approx(0.4, abs=0.01)
    assert seen["obstacle2.seen"] == seen["obstacle2.x"] == 0.0


def test_sensors_are_observed_as_shares_of_their_range(rovers: InProcessMatch) -> None:
    readings = {
        "scan": RangeReading(age=0.0, angle_min=0.0, angle_increment=1.0, distances=[1.25, None, 5.0, 0.5]),
        "north": CompassReading(age=0.0, heading=-math.pi / 3),
        "bumper": ContactReading(age=0.0, touched=[True, False]),
    }
    seen, nothing = observed(rovers, "one", sensors=readings), observed(rovers, "one", sensors={})
    names = [*(f"scan.beam{beam}" for beam in range(1, 5)), "north.cos", "north.sin", "bumper.sector1"]
    names.append("bumper.sector2")
    half, root = 0.5, math.sqrt(3) / 2
    assert [seen[name] for name in names] == pytest.approx([0.25, 1.0, 1.0, 0.1, half, -root, 1.0, 0.0])
    assert [nothing[name] for name in names] == [1.0] * 4 + [0.0] * 4


def test_each_quantity_is_observed_in_its_scale_and_in_the_body_frame(keepers: InProcessMatch) -> None:
    setup = keepers.simulation.setup()
    game = keepers.simulation.now.sights.perceived["cyan1"].game
    seen = observed(
        keepers,
        "cyan1",
        self=Motion(x=1.1, y=-2.0, heading=math.pi / 2, vx=0.5, vy=1.0, omega=-0.5),
        stuck=True,
        ball=BallSight(x=0.1, y=0.5, vx=1.0, vy=-2.0, age=0.25),
        holding=True,
        kicker_ready=False,
        obstacles=[Obstacle(2.1, 1.0, 0.3)],
        game=game.replace(left=15.0, running=True),
    )
    wanted = {
        "me.x": 0.1,
        "me.y": -2.0 / setup.pitch.touch_line,
        "me.vx": 1.0 / setup.drive.max_speed,
        "me.vy": -0.5 / setup.drive.max_speed,
        "me.omega": -0.5 / setup.drive.max_turn_rate,
        "me.stuck": 1.0,
        "ball.x": 0.5,
        "ball.y": 0.2,
        "ball.vx": -0.4,
        "ball.vy": -0.2,
        "ball.age": 0.25,
        "ball.held": 1.0,
        "kicker.ready": 0.0,
        "goal.x": 0.4,
        "goal.y": -1.98,
        "own_goal.x": 0.4,
        "own_goal.y": 2.42,
        "obstacle1.x": 0.6,
        "obstacle1.y": -0.2,
        "obstacle1.radius": 0.3,
        "time.left": 0.25,
        "game.running": 1.0,
    }
    assert {name: seen[name] for name in wanted} == pytest.approx(wanted)
    other = observed(keepers, "cyan1", kicker_ready=True, game=game.replace(left=None, running=False))
    names = ("me.stuck", "ball.held", "kicker.ready", "time.left", "game.running")
    assert [other[name] for name in names] == [0.0, 0.0, 1.0, 1.0, 0.0]


def test_a_match_without_a_ball_has_no_entries_of_one(rovers: InProcessMatch, keepers: InProcessMatch) -> None:
    assert not [name for name in observed(rovers, "one") if "ball" in name or "goal" in name]
    assert {"ball.x", "goal.x", "kicker.ready"} <= {*observed(keepers, "cyan1")}


def test_a_ball_is_observed_where_it_is_and_zeros_before_it_is_seen(keepers: InProcessMatch) -> None:
    seen, world = observed(keepers, "cyan1"), keepers.simulation.now.world
    ahead = world["ball"]["x"] - world["robots"]["cyan1"]["x"]  # the robot looks along +x
    assert (seen["ball.seen"], seen["ball.x"]) == (1.0, pytest.approx(ahead / 5, abs=0.01))
    unseen = observed(keepers, "cyan1", ball=None)
    assert [unseen[f"ball.{name}"] for name in ("seen", "x", "y", "vx", "vy", "age")] == [0.0] * 6


def test_a_teammate_is_observed_by_its_radio_alone(keepers: InProcessMatch) -> None:
    silent = observed(keepers, "cyan1")
    assert (silent["mate1.heard"], silent["mate2.heard"]) == (0.0, 0.0)
    heard = {"cyan3": ReceivedRadio(self=Motion(x=1.0, y=0.5, heading=0.0, vy=-1.0), age=0.4)}
    seen = observed(keepers, "cyan1", radio=heard, self=Motion(x=0.0, y=0.0, heading=math.pi / 2))
    assert (seen["mate1.heard"], seen["mate2.heard"]) == (0.0, 1.0)
    assert (seen["mate2.x"], seen["mate2.y"]) == (pytest.approx(0.1), pytest.approx(-0.2))
    assert seen["mate2.vx"] < 0 and seen["mate2.age"] == pytest.approx(0.4)


def test_both_sides_observe_the_same_from_mirrored_places(keepers: InProcessMatch) -> None:
    game = keepers.simulation.now.sights.perceived["cyan1"].game
    same = {
        "self": Motion(x=-1.0, y=0.5, heading=0.3, vx=1.0),
        "ball": BallSight(x=1.0, y=2.0, vx=0.5, vy=-0.5),
        "obstacles": [Obstacle(2.0, 1.0, 0.3)],
        "game": game,
    }
    cyan, magenta = observed(keepers, "cyan1", (2.0, 1.0), **same), observed(keepers, "magenta1", (-2.0, -1.0), **same)
    assert cyan["zone.square.x"] > 0.0
    assert magenta == {name: number for name, number in cyan.items() if not name.startswith("mate2")}


def test_zones_stay_where_they_are_when_teams_change_ends(keepers: InProcessMatch) -> None:
    for robot, half, sign in (("cyan1", 1, 1), ("cyan1", 2, -1), ("magenta1", 2, 1), ("magenta1", 3, -1)):
        game = keepers.simulation.now.sights.perceived[robot].game.replace(half=half)
        seen = observed(keepers, robot, (2.0, 1.0), game=game, self=Motion(x=0.0, y=0.0, heading=0.0))
        assert (seen["zone.square.x"], seen["zone.square.y"]) == pytest.approx((sign * 0.4, sign * 0.2))


def test_what_is_beyond_the_limits_is_cut_off(keepers: InProcessMatch) -> None:
    seen = observed(keepers, "cyan1", self=Motion(x=1e6, y=0.0, heading=0.0, omega=1e6))
    assert seen["me.x"] < 2.0 and seen["me.omega"] == 2.0


def test_the_parameters_of_a_team_choose_what_is_observed(rovers: InProcessMatch) -> None:
    setup = rovers.simulation.setup()
    teams = {side: team.replace(parameters={"observe": "sensors motion"}) for side, team in setup.teams.items()}
    layout = Observation(Briefing.of("one", setup.replace(teams=teams)))
    assert [name.partition(".")[0] for name in layout.names] == ["me"] * 4 + ["scan"] * 4 + ["north"] * 2 + [
        "bumper"
    ] * 2
    assert "me.x" not in layout.names


def test_every_entry_says_what_it_is(rovers: InProcessMatch, keepers: InProcessMatch) -> None:
    for match, robot in ((rovers, "one"), (keepers, "cyan1")):
        entries = Observation(Briefing.of(robot, match.simulation.setup())).entries
        assert len({entry.name for entry in entries}) == len(entries)
        assert all(entry.meaning and entry.unit and entry.low < entry.high for entry in entries)
