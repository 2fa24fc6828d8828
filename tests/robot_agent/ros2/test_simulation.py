"""What the services of simulation_interfaces do to a match, on the in-process bus, without a graph."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import pytest

pytest.importorskip("xxhash")

from robot_agent.ros2.simulation.codes import Category, Code, Feature, RefusedError, Scope, State
from robot_agent.ros2.simulation.match_client import MatchClient
from robot_agent.ros2.simulation.services import SimulationServices
from robot_agent.ros2.simulation.steps import Outcome, Steps
from runtime.ros2.message_types import typestore
from schemas.config.match_config import MatchConfig
from support.host_rig import TEAMS, HostRig
from support.paused_host import SHOW, pace, paused_match, stepped_to
from support.ros_control import made

WALL = {"name": "wall", "shape": "box", "place": [0.0, 5.0], "size": [1.0, 0.2, 0.5]}
CRATE = {"name": "crate", "shape": "box", "place": [2.0, 5.0], "size": [0.4, 0.4, 0.4], "mass": 2.0}
CART = '{"shape": "box", "size": [0.4, 0.4, 0.4], "mass": 2.0}'
POLE = '{"shape": "cylinder", "radius": 0.2, "height": 0.5}'


class Simulator:
    """A paused match, and the services as nodes call them."""

    def __init__(self, rig: HostRig) -> None:
        self.rig = rig
        self.match = MatchClient(rig.seat(), rig.host.simulation.setup())
        self.handlers = SimulationServices(self.match).handlers

    def call(self, name: str, version: str = "", /, **fields: Any) -> Mapping[str, Any]:
        asked = made(typestore(version), f"simulation_interfaces/srv/{name}_Request", fields)
        return self.handlers[name](asked)

    def refusal(self, name: str, version: str = "", /, **fields: Any) -> tuple[Code, str]:
        with pytest.raises(RefusedError) as refused:
            self.call(name, version, **fields)
        return refused.value.code, str(refused.value)

    def step(self) -> None:
        stepped_to(self.rig, self.rig.host.simulation.now.tick + 1)


@pytest.fixture
def simulator() -> Iterator[Simulator]:
    """A small match with obstacles that is paused at tick 1; its robots drive ahead."""
    rig = HostRig(MatchConfig.model_validate({"seed": 7, "teams": TEAMS, "obstacles": [WALL, CRATE]}))
    rig.join_all()
    made = Simulator(rig)
    rig.begin()
    rig.ticks(1)
    with paused_match(rig):
        yield made
    rig.host.simulation.close()


def pose(x: float, y: float, heading: float = 0.0, z: float = 0.0) -> dict[str, Any]:
    turn = {"z": math.sin(heading / 2), "w": math.cos(heading / 2)}
    return {"position": {"x": x, "y": y, "z": z}, "orientation": turn}


def test_entities_are_robots_ball_and_obstacles(simulator: Simulator) -> None:
    names = ["cyan1", "cyan2", "magenta1", "ball", "wall", "crate"]
    assert simulator.call("GetEntities")["entities"] == names


@pytest.mark.parametrize(
    ("filters", "names"),
    [
        ({"filter": "^cyan"}, ["cyan1", "cyan2"]),
        ({"categories": [{"category": Category.ROBOT}], "filter": "1"}, ["cyan1", "magenta1"]),
        ({"categories": [{"category": Category.STATIC_OBJECT}]}, ["wall"]),
        ({"categories": [{"category": Category.DYNAMIC_OBJECT}]}, ["ball", "crate"]),
        ({"bounds": {"type": 3, "points": [{"x": 1.2, "y": 5.0}, {"x": 0.6}]}}, ["crate"]),
        ({"bounds": {"type": 3, "points": [{"x": 1.2, "y": 5.0}, {"x": 0.75}]}}, ["wall", "crate"]),
    ],
)
def test_entities_are_chosen_by_name_category_and_sphere(
    simulator: Simulator, filters: dict[str, Any], names: list[str]
) -> None:
    assert simulator.call("GetEntities", filters=filters)["entities"] == names
    found = simulator.call("GetEntitiesStates", filters=filters)
    assert found["entities"] == names
    assert len(found["states"]) == len(names)


@pytest.mark.parametrize(
    ("filters", "code"),
    [
        ({"filter": "("}, Code.FAILED),
        ({"filter": "x{4294967295}"}, Code.FAILED),
        ({"filter": "(" * 100_000}, Code.FAILED),
        ({"tags": {"tags": ["blue"]}}, Code.UNSUPPORTED),
        ({"bounds": {"type": 1, "points": [{}, {}]}}, Code.UNSUPPORTED),
    ],
)
def test_what_a_filter_cannot_do_is_refused(simulator: Simulator, filters: dict[str, Any], code: Code) -> None:
    assert simulator.refusal("GetEntities", filters=filters)[0] == code


def test_a_state_is_the_truth_in_the_field_frame(simulator: Simulator) -> None:
    state, truth = simulator.call("GetEntityState", entity="magenta1")["state"], simulator.rig.truth("magenta1")
    assert (state.header.frame_id, state.header.stamp.nanosec) == ("map", 20_000_000)
    turn = state.pose.orientation
    assert (state.pose.position.x, state.pose.position.y) == (truth["x"], truth["y"])
    assert 2 * math.atan2(turn.z, turn.w) == pytest.approx(truth["heading"])
    assert (state.twist.linear.x, state.twist.angular.z) == (truth["vx"], truth["omega"])
    assert simulator.refusal("GetEntityState", entity="cyan9")[0] == Code.NOT_FOUND


def test_a_pose_is_set_with_the_next_tick_and_the_velocity_stays(simulator: Simulator) -> None:
    simulator.call("SetEntityState", entity="magenta1", state={"pose": pose(-1.0, 4.0, 1.0)}, set_pose=True)
    before = simulator.rig.truth("magenta1")
    simulator.step()
    after = simulator.rig.truth("magenta1")
    assert (after["x"], after["y"], after["heading"]) == pytest.approx((-1.0, 4.0, 1.0), abs=0.01)
    assert math.hypot(after["vx"], after["vy"]) >= math.hypot(before["vx"], before["vy"]) > 0.0


def test_a_velocity_is_set_and_the_pose_stays(simulator: Simulator) -> None:
    before = simulator.rig.host.simulation.now.world["ball"]
    simulator.call("SetEntityState", entity="ball", state={"twist": {"linear": {"y": 3.0}}}, set_twist=True)
    simulator.step()
    ball = simulator.rig.host.simulation.now.world["ball"]
    assert (ball["x"], ball["y"]) == pytest.approx((before["x"], before["y"] + 0.06), abs=0.01)
    assert ball["vy"] == pytest.approx(3.0, abs=0.1)


def test_pose_and_velocity_are_set_one_after_the_other_in_a_pause(simulator: Simulator) -> None:
    simulator.call("SpawnEntity", **spawn("cart", CART))
    for name, x in (("ball", 3.0), ("cart", 5.0)):
        simulator.call("SetEntityState", entity=name, state={"pose": pose(x, -4.0)}, set_pose=True)
        simulator.call("SetEntityState", entity=name, state={"twist": {"linear": {"y": 1.0}}}, set_twist=True)
    simulator.step()
    for name, x in (("ball", 3.0), ("cart", 5.0)):
        state = simulator.call("GetEntityState", entity=name)["state"]
        place, speed = state.pose.position, state.twist.linear
        assert (place.x, place.y, speed.y) == pytest.approx((x, -3.98, 1.0), abs=0.2)


def test_in_releases_without_flags_all_of_a_state_is_set(simulator: Simulator) -> None:
    state = {"pose": pose(3.0, -4.0), "twist": {"linear": {"x": 1.0}}}
    simulator.call("SetEntityState", "1.x", entity="ball", state=state)
    simulator.step()
    ball = simulator.rig.host.simulation.now.world["ball"]
    assert (ball["x"], ball["y"], ball["vx"]) == pytest.approx((3.02, -4.0, 1.0), abs=0.03)


@pytest.mark.parametrize(
    ("name", "fields", "code"),
    [
        ("cyan9", {"state": {"pose": pose(0.0, 3.0)}, "set_pose": True}, Code.NOT_FOUND),
        ("cyan2", {"state": {"pose": {"position": {"x": 1.0}}}, "set_pose": True}, Code.INVALID_POSE),
        ("cyan2", {"state": {"pose": pose(math.nan, 0.0)}, "set_pose": True}, Code.INVALID_POSE),
        ("cyan2", {"state": {"header": {"frame_id": "odom"}, "pose": pose(0.0, 3.0)}, "set_pose": True}, 101),
        ("cyan2", {"state": {"pose": pose(90.0, 3.0)}, "set_pose": True}, Code.FAILED),
        ("wall", {"state": {"pose": pose(0.0, 3.0)}, "set_pose": True}, Code.FAILED),
        ("cyan2", {"set_acceleration": True}, Code.UNSUPPORTED),
    ],
)
def test_a_state_that_is_impossible_is_refused(
    simulator: Simulator, name: str, fields: dict[str, Any], code: Code
) -> None:
    assert simulator.refusal("SetEntityState", entity=name, **fields)[0] == code


def spawn(name: str, text: str, x: float = 4.0, **more: Any) -> dict[str, Any]:
    return {"name": name, "entity_resource": {"resource_string": text}, "initial_pose": {"pose": pose(x, 4.0)}, **more}


def test_bodies_are_spawned_together_and_deleted(simulator: Simulator) -> None:
    asked = [spawn("pole", POLE), spawn("", '{"side": "magenta"}', 5.0, allow_renaming=True), spawn("cyan1", POLE)]
    found = simulator.call("SpawnEntities", spawn_requests=asked)
    assert found["result"].result == Code.SPAWN_FAILED
    assert [one.result.result for one in found["results"]] == [Code.OK, Code.OK, Code.NAME_NOT_UNIQUE]
    assert [one.entity_name for one in found["results"]] == ["pole", "robot_1", ""]
    simulator.step()
    assert simulator.rig.truth("robot_1")["x"] == pytest.approx(5.0)
    simulator.call("DeleteEntity", entity="pole")
    simulator.step()
    assert "pole" not in simulator.call("GetEntities")["entities"]
    assert simulator.refusal("DeleteEntity", entity="pole")[0] == Code.NOT_FOUND
    assert simulator.refusal("DeleteEntity", entity="ball")[0] == Code.UNSUPPORTED


@pytest.mark.parametrize(
    ("fields", "code"),
    [
        (spawn("Pole", POLE), Code.NAME_INVALID),
        (spawn("", POLE), Code.NAME_INVALID),
        (spawn("pole", ""), Code.NO_RESOURCE),
        (spawn("pole", "<sdf/>"), Code.RESOURCE_PARSE_ERROR),
        (spawn("pole", "[]"), Code.RESOURCE_PARSE_ERROR),
        (spawn("pole", "[" * 100_000), Code.RESOURCE_PARSE_ERROR),
        (spawn("pole", '{"shape": "cylinder"}'), Code.RESOURCE_PARSE_ERROR),
        (spawn("pole", POLE, entity_namespace="a"), Code.NAMESPACE_INVALID),
        (spawn("pole", POLE, initial_pose={}), Code.INVALID_SPAWN_POSE),
        (spawn("pole", POLE) | {"entity_resource": {"uri": "model://pole"}}, Code.UNSUPPORTED_FORMAT),
    ],
)
def test_a_body_that_is_impossible_is_not_spawned(simulator: Simulator, fields: dict[str, Any], code: Code) -> None:
    assert simulator.refusal("SpawnEntity", **fields)[0] == code


def test_a_request_of_a_release_without_resources_spawns_a_body(simulator: Simulator) -> None:
    fields = {"name": "pole", "resource_string": POLE, "initial_pose": {"pose": pose(4.0, 4.0)}}
    assert simulator.call("SpawnEntity", "1.x", **fields) == {"entity_name": "pole"}


def test_a_reset_goes_back_to_the_start_or_removes_what_was_spawned(simulator: Simulator) -> None:
    start = simulator.rig.truth("cyan1")["x"]
    simulator.call("SpawnEntity", **spawn("pole", POLE))
    simulator.call("SetEntityState", entity="cyan1", state={"pose": pose(-1.0, 4.0)}, set_pose=True)
    simulator.step()
    simulator.call("ResetSimulation", scope=Scope.SPAWNED)
    simulator.step()
    assert "pole" not in simulator.call("GetEntities")["entities"]
    assert simulator.rig.truth("cyan1")["x"] == pytest.approx(-1.0, abs=0.1)
    simulator.call("ResetSimulation", scope=Scope.STATE | Scope.SPAWNED)
    simulator.step()
    assert simulator.rig.truth("cyan1")["x"] == pytest.approx(start, abs=0.1)


def test_a_reset_removes_what_was_spawned_in_the_same_pause(simulator: Simulator) -> None:
    simulator.call("SpawnEntity", **spawn("pole", POLE))
    simulator.call("SpawnEntity", **spawn("post", POLE, 5.0))
    simulator.call("DeleteEntity", entity="post")
    simulator.call("ResetSimulation", scope=Scope.SPAWNED)
    simulator.call("SpawnEntity", **spawn("post", POLE, 6.0))
    simulator.step()
    assert simulator.call("GetEntities", filters={"filter": "^po"})["entities"] == ["post"]


def test_after_a_reset_a_state_is_set_as_a_whole_until_the_next_tick(simulator: Simulator) -> None:
    simulator.call("DeleteEntity", entity="cyan2")
    simulator.call("ResetSimulation", scope=Scope.STATE)
    asked: dict[str, Any] = {"entity": "cyan2", "state": {"pose": pose(-1.0, 4.0)}, "set_pose": True}
    assert simulator.refusal("SetEntityState", **asked)[0] == Code.INCORRECT_STATE
    simulator.call("SetEntityState", **asked, set_twist=True)
    simulator.step()
    assert simulator.rig.truth("cyan2")["x"] == pytest.approx(-1.0, abs=0.01)
    simulator.call("SetEntityState", **asked)


@pytest.mark.parametrize("scope", [0, Scope.TIME, 255])
def test_simulated_time_is_never_reset(simulator: Simulator, scope: int) -> None:
    code, reason = simulator.refusal("ResetSimulation", scope=scope)
    assert code == Code.UNSUPPORTED
    assert "STATE | SPAWNED" in reason


def test_the_state_of_the_simulation_is_read_and_set(simulator: Simulator) -> None:
    assert simulator.call("GetSimulationState")["state"].state == State.PAUSED
    assert simulator.refusal("SetSimulationState", state={"state": State.PAUSED})[0] == Code.ALREADY_IN_TARGET_STATE
    assert simulator.refusal("SetSimulationState", state={"state": State.STOPPED})[0] == Code.UNSUPPORTED
    assert simulator.call("SetSimulationState", state={"state": State.PLAYING}) == {}


def test_the_features_are_those_of_the_services_that_are_there(simulator: Simulator) -> None:
    found = simulator.call("GetSimulatorFeatures")["features"]
    assert set(found.features) == set(Feature)
    assert found.spawn_formats == ["touchline"]


def test_steps_tell_what_is_done_and_end_with_their_last_tick(simulator: Simulator) -> None:
    ends: list[Outcome] = []
    agent = simulator.rig.agents["cyan1"]
    agent.frozen = True
    steps = Steps(simulator.match, simulator.rig.clock, 3, ends.append)
    told = steps.follow(0.02)
    assert told is not None and sum(told) == 3
    assert ends == []
    agent.frozen = False
    while (later := steps.follow(0.02)) is not None:
        assert sum(later) == 3 and later >= told
    assert ends == [Outcome(Code.OK)]
    assert pace(simulator.rig, SHOW).tick == 4


def test_steps_that_are_canceled_pause_the_match_at_once(simulator: Simulator) -> None:
    ends: list[Outcome] = []
    steps = Steps(simulator.match, simulator.rig.clock, 1_000_000, ends.append)
    simulator.rig.agents["cyan1"].frozen = True
    steps.cancel()
    while steps.follow(0.02) is not None:
        pass
    assert ends[0].is_canceled
    assert ends[0].code == Code.FAILED


@pytest.mark.parametrize(("ticks", "said"), [(0, "steps is 0; ask for 1 or more"), (10**10, "ticks is 10000000000; ")])
def test_steps_of_no_possible_number_are_refused(simulator: Simulator, ticks: int, said: str) -> None:
    with pytest.raises(RefusedError, match=said):
        Steps(simulator.match, simulator.rig.clock, ticks, lambda _: None)
