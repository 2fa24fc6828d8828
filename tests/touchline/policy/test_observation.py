"""What a robot observes: each entry is named, in its scale, in the body frame, and within its limits."""

import math

import numpy as np
import pytest

from robot_agent.sdk.contract import Briefing
from schemas.messages.radio import Motion
from schemas.messages.sight import ReceivedRadio, Sight
from touchline.play.play_match import InProcessMatch
from touchline.policy.observation import Observation


def observed(match: InProcessMatch, robot: str, **changes: object) -> dict[str, float]:
    """Name → number of what a robot observes; `changes` are of its sight."""
    layout = Observation(Briefing.of(robot, match.simulation.setup()))
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
    seen = observed(rovers, "one")
    beams = [seen[f"scan.beam{number}"] for number in range(1, 5)]
    assert max(beams) == 1.0
    assert (seen["north.cos"], seen["north.sin"]) == (pytest.approx(0.0, abs=1e-4), pytest.approx(1.0))
    assert (seen["bumper.sector1"], seen["bumper.sector2"]) == (0.0, 0.0)
    nothing = observed(rovers, "one", sensors={})
    assert [nothing[name] for name in ("scan.beam1", "north.cos", "north.sin", "bumper.sector1")] == [1.0, 0, 0, 0]


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
    cyan, magenta = observed(keepers, "cyan1"), observed(keepers, "magenta1")
    assert cyan["zone.square.x"] > 0 and magenta["zone.square.x"] > 0  # both look at the middle
    assert cyan["goal.x"] > 0 > cyan["own_goal.x"]


def test_zones_stay_where_they_are_when_teams_change_ends(keepers: InProcessMatch) -> None:
    setup = keepers.simulation.setup()
    assert setup.task is not None
    zone = setup.task.zones[0].model_copy(update={"place": (2.0, 1.0)})
    moved = setup.replace(task=setup.task.replace(zones=[zone]))
    for robot, half, sign in (("cyan1", 1, 1), ("cyan1", 2, -1), ("magenta1", 2, 1), ("magenta1", 3, -1)):
        sight = keepers.simulation.now.sights.perceived[robot]
        there = sight.replace(game=sight.game.replace(half=half), self=Motion(x=0.0, y=0.0, heading=0.0))
        layout = Observation(Briefing.of(robot, moved))
        seen = dict(zip(layout.names, layout.observe(there).tolist(), strict=True))
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
