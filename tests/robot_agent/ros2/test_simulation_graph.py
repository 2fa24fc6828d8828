"""The services and the action of simulation_interfaces on a graph, asked for by a plain client of Zenoh."""

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
import zenoh

pytest.importorskip("xxhash")

from robot_agent.ros2.simulation.codes import Code, GoalStatus
from robot_agent.ros2.simulation.control import OLDER, SimulationControl
from robot_agent.ros2.simulation.match_client import MatchClient
from runtime.process.clock import WallClock
from runtime.ros2.graph import Graph, open_graph
from runtime.ros2.graph_names import Attachment, Endpoint, Kind, data_key
from runtime.ros2.message_types import hash_of, typestore
from runtime.ros2.topic_type import TopicType
from schemas.config.match_config import MatchConfig
from support.host_rig import TEAMS, HostRig
from support.paused_host import PAUSE, RUN, SHOW, pace, paused_match
from support.process_story import wait_for
from support.ros_control import made

LIMIT_S = 60.0
PLACE = "/touchline/simulate_steps/_action"
SEND = TopicType("simulation_interfaces/action/SimulateSteps_SendGoal")
GET = TopicType("simulation_interfaces/action/SimulateSteps_GetResult")
CANCEL = TopicType("action_msgs/srv/CancelGoal")
FEEDBACK = TopicType("simulation_interfaces/action/SimulateSteps_FeedbackMessage")
STATUS = TopicType("action_msgs/msg/GoalStatusArray")
ENDLESS = 1_000_000
"""Steps that outlast a test."""
GOAL = {"uuid": np.arange(16, dtype=np.uint8)}


class Caller:
    """A client in the graph of a match that is paused."""

    def __init__(self, rig: HostRig, match: MatchClient, graph: Graph, session: zenoh.Session) -> None:
        self.rig, self.match, self.graph, self.session = rig, match, graph, session

    def begin(self, service: str, topic_type: TopicType, payload: bytes) -> Any:
        """Send a request; the replies come later."""
        return self.session.get(
            data_key(0, service, topic_type, hash_of(topic_type)),
            payload=payload,
            attachment=Attachment(1, 1, bytes(16)).pack(),
            target=zenoh.QueryTarget.ALL_COMPLETE,
            timeout=LIMIT_S,
        )

    def call(self, service: str, topic_type: TopicType, **fields: Any) -> Any:
        """The response."""
        return self.result(topic_type, self.begin(service, topic_type, encoded(topic_type, fields)))

    def result(self, topic_type: TopicType, replies: Any) -> Any:
        (reply,) = list(replies)
        return typestore().deserialize_cdr(reply.ok.payload.to_bytes(), f"{topic_type.message}_Response")

    def listen(self, topic: str, topic_type: TopicType) -> list[Any]:
        """The messages of a topic from now on."""
        heard: list[Any] = []
        self.session.declare_subscriber(
            data_key(0, topic, topic_type, hash_of(topic_type)),
            lambda sample: heard.append(typestore().deserialize_cdr(sample.payload.to_bytes(), topic_type.message)),
        )
        return heard

    def simulation(self, name: str, service: str, version: str = "", **fields: Any) -> Any:
        return self.call(
            f"/touchline/{service}", TopicType(f"simulation_interfaces/srv/{name}", version=version), **fields
        )


def encoded(topic_type: TopicType, fields: dict[str, Any]) -> bytes:
    store, name = typestore(topic_type.version), f"{topic_type.message}_Request"
    return bytes(store.serialize_cdr(made(store, name, fields), name))


@pytest.fixture
def caller() -> Iterator[Caller]:
    rig = HostRig(MatchConfig.model_validate({"seed": 7, "teams": TEAMS}))
    rig.join_all()
    match = MatchClient(rig.seat(), rig.host.simulation.setup())
    rig.begin()
    rig.ticks(1)
    with open_graph("touchline", WallClock(), 0, "tcp/127.0.0.1:0", None, 10.0) as graph:
        config = zenoh.Config()
        for key, value in {"connect/endpoints": [graph.endpoint], "scouting/multicast/enabled": False}.items():
            config.insert_json5(key, json.dumps(value))
        with paused_match(rig), SimulationControl(graph, match), zenoh.open(config) as session:
            yield Caller(rig, match, graph, session)
    rig.host.simulation.close()


def test_each_service_is_there_under_the_hash_of_each_release(caller: Caller) -> None:
    seen: list[Endpoint] = []
    for service in ("set_entity_state", "spawn_entity", "get_entities", "step_simulation"):
        caller.graph.watch(f"/touchline/{service}", Kind.SERVICE, lambda one, _: seen.append(one))
    wait_for(lambda: len(seen) >= 6)
    hashes = {one.type_hash for one in seen}
    for name in ("SetEntityState", "SpawnEntity"):
        assert {hash_of(TopicType(f"simulation_interfaces/srv/{name}", version=old)) for old in ("", OLDER)} <= hashes
    assert len(seen) == len(hashes) == 6


def test_a_step_is_replied_to_after_its_last_tick(caller: Caller) -> None:
    reply = caller.simulation("StepSimulation", "step_simulation", steps=5)
    assert (reply.result.result, reply.result.error_message) == (Code.OK, "")
    assert pace(caller.rig, SHOW).tick == 6
    state = caller.simulation("GetEntityState", "get_entity_state", entity="cyan1").state
    assert state.header.stamp.nanosec == 6 * 20_000_000


def test_a_match_that_runs_cannot_be_stepped(caller: Caller) -> None:
    assert caller.simulation("SetSimulationState", "set_simulation_state", state={"state": 1}).result.result == Code.OK
    assert caller.simulation("StepSimulation", "step_simulation", steps=1).result.result == Code.FAILED


def test_what_is_refused_has_a_response_with_empty_fields(caller: Caller) -> None:
    reply = caller.simulation("GetEntityState", "get_entity_state", entity="cyan9")
    assert (reply.result.result, reply.state.pose.position.x) == (Code.NOT_FOUND, 0.0)
    kind = TopicType("simulation_interfaces/srv/GetEntityState")
    reply = caller.result(kind, caller.begin("/touchline/get_entity_state", kind, b"\x00\x01\x00\x00\xff"))
    assert reply.result.result == Code.FAILED
    assert "simulation_interfaces/srv/GetEntityState" in reply.result.error_message
    reply = caller.simulation("SetEntityState", "set_entity_state", OLDER, entity="wall")
    assert reply.result.result == Code.NOT_FOUND


def test_services_go_on_after_a_request_that_fails_in_an_unforeseen_way(
    caller: Caller, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with monkeypatch.context() as broken:
        broken.setattr(caller.match, "entities", lambda: [].pop())
        reply = caller.simulation("GetEntities", "get_entities")
    assert (reply.result.result, reply.result.error_message) == (Code.FAILED, "IndexError: pop from empty list")
    assert "in <lambda>" in capsys.readouterr().err
    assert caller.simulation("GetEntities", "get_entities").result.result == Code.OK


def test_the_action_of_steps_tells_its_result(caller: Caller) -> None:
    assert caller.call(f"{PLACE}/send_goal", SEND, goal_id=GOAL, goal={"steps": 20}).accepted
    assert not caller.call(f"{PLACE}/send_goal", SEND, goal_id=GOAL, goal={"steps": 20}).accepted
    found = caller.call(f"{PLACE}/get_result", GET, goal_id=GOAL)
    assert (found.status, found.result.result.result) == (GoalStatus.SUCCEEDED, Code.OK)
    assert pace(caller.rig, SHOW).tick == 21


def test_a_goal_of_a_match_that_runs_is_aborted(caller: Caller) -> None:
    pace(caller.rig, RUN)
    caller.call(f"{PLACE}/send_goal", SEND, goal_id=GOAL, goal={"steps": 20})
    found = caller.call(f"{PLACE}/get_result", GET, goal_id=GOAL)
    assert (found.status, found.result.result.result) == (GoalStatus.ABORTED, Code.FAILED)


def test_a_goal_tells_its_progress_until_it_is_canceled_and_the_match_is_paused(caller: Caller) -> None:
    statuses, told = caller.listen(f"{PLACE}/status", STATUS), caller.listen(f"{PLACE}/feedback", FEEDBACK)
    caller.call(f"{PLACE}/send_goal", SEND, goal_id=GOAL, goal={"steps": ENDLESS})
    progress = wait_for(lambda: told[1:])[0].feedback
    assert progress.completed_steps > 0 and progress.completed_steps + progress.remaining_steps == ENDLESS
    waiting = caller.begin(f"{PLACE}/get_result", GET, encoded(GET, {"goal_id": GOAL}))
    reply = caller.call(f"{PLACE}/cancel_goal", CANCEL, goal_info={"goal_id": GOAL})
    assert (reply.return_code, len(reply.goals_canceling)) == (0, 1)
    found = caller.result(GET, waiting)
    assert (found.status, found.result.result.result) == (GoalStatus.CANCELED, Code.FAILED)
    assert pace(caller.rig, SHOW).paused
    wait_for(lambda: statuses and statuses[-1].status_list[0].status == GoalStatus.CANCELED)
    other = {"uuid": np.full(16, 7, np.uint8)}
    assert caller.call(f"{PLACE}/cancel_goal", CANCEL, goal_info={"goal_id": other}).return_code == 2
    assert caller.call(f"{PLACE}/cancel_goal", CANCEL, goal_info={"goal_id": GOAL}).return_code == 3


def test_steps_that_an_operator_ends_have_failed(caller: Caller) -> None:
    step = TopicType("simulation_interfaces/srv/StepSimulation")
    waiting = caller.begin("/touchline/step_simulation", step, encoded(step, {"steps": ENDLESS}))
    wait_for(lambda: pace(caller.rig, SHOW).until not in (None, 1))
    pace(caller.rig, PAUSE)
    reply = caller.result(step, waiting)
    assert reply.result.result == Code.FAILED
    assert "somebody else" in reply.result.error_message
