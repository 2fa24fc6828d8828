"""A match that nodes drive, paused, stepped, changed and kicked in by services that a foreign library calls."""

import json
import re
import subprocess
import sys
from contextlib import ExitStack
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from recordings.reading.recording import open_recording
from runtime.ros2.message_types import hash_of
from runtime.ros2.topic_type import TopicType
from schemas.config.profile import load_profile
from schemas.topics import COMMAND
from support.ros_match import TEAM, graph_at, said_in, started, touchline
from touchline.verify.resimulate import verify

pytestmark = [
    pytest.mark.skipif(None in map(find_spec, ("xxhash", "zenoh_ros2_sdk")), reason="needs xxhash and zenoh_ros2_sdk"),
    pytest.mark.processes,
    pytest.mark.slow,
]

CONTROL = Path(__file__).parents[2] / "support" / "ros_control.py"
OK, NOT_FOUND, FAILED, UNSUPPORTED = 1, 2, 4, 0
PLAYING, PAUSED = 1, 2
START_TICK = 250
"""The kick-off has been started."""
MATCH = """
name = "controlled"
seed = 5
duration = 4.0
rules = "friendly"

[teams.cyan]
remote = true
robots = ["cyan1", "cyan2"]

[teams.magenta]
brain = "simple"
robots = ["magenta1", "magenta2"]
"""


class Client:
    """The foreign client, a call at a time."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def call(self, service: str, kind: str, version: str = "", /, **request: Any) -> Any:
        type_hash = hash_of(TopicType(kind, version=version))
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.write(json.dumps([service, kind, version, type_hash, request]) + "\n")
        self._process.stdin.flush()
        return json.loads(self._process.stdout.readline())

    def simulation(self, name: str, version: str = "", /, **request: Any) -> Any:
        service = re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower()
        return self.call(f"/touchline/{service}", f"simulation_interfaces/srv/{name}", version, **request)

    def result(self, name: str, version: str = "", /, **request: Any) -> int:
        found: int = self.simulation(name, version, **request)["result"]["result"]
        return found


def pose(x: float, y: float) -> dict[str, Any]:
    return {"pose": {"position": {"x": x, "y": y}, "orientation": {"w": 1.0}}}


def check_services(client: Client) -> None:
    """Read, change and step the match, which is paused."""
    names = ["cyan1", "cyan2", "magenta1", "magenta2", "ball"]
    assert client.simulation("GetEntities")["entities"] == names
    assert client.result("StepSimulation", steps=1) == OK
    before = client.simulation("GetEntityState", entity="ball")["state"]["header"]["stamp"]
    assert client.result("StepSimulation", steps=5) == OK
    after = client.simulation("GetEntityState", entity="ball")["state"]["header"]["stamp"]
    passed = (after["sec"] - before["sec"]) * 10**9 + after["nanosec"] - before["nanosec"]
    assert passed == 5 * 20_000_000
    pole = {"resource_string": '{"shape": "cylinder", "radius": 0.2, "height": 0.5}'}
    spawned = {"name": "pole", "entity_resource": pole, "initial_pose": pose(5.0, -5.0)}
    assert client.result("SpawnEntities", spawn_requests=[spawned]) == OK
    spawned = {"name": "other", **pole, "initial_pose": pose(-5.0, -5.0)}
    assert client.result("SpawnEntity", "1.x", **spawned) == OK
    assert client.result("StepSimulation", steps=1) == OK
    assert client.simulation("GetEntitiesStates", filters={"filter": "pole|other"})["entities"] == ["pole", "other"]
    assert client.result("DeleteEntity", entity="pole") == OK
    assert client.result("ResetSimulation", scope=1) == UNSUPPORTED
    assert client.result("ResetSimulation", scope=6) == OK
    assert client.result("StepSimulation", steps=1) == OK
    assert client.simulation("GetEntities")["entities"] == names


def kicked(client: Client) -> tuple[Any, Any]:
    """The replies of the service `kick` far from the ball and with it; the ball rolls fast afterwards."""
    far = client.call("/cyan2/kick", "touchline_msgs/srv/Kick", mode="ground", speed=5.0)
    body, ball = load_profile("msl").robot, load_profile("msl").ball
    assert client.result("SetEntityState", entity="cyan2", state=pose(-3.0, 3.0), set_pose=True) == OK
    ball_at = pose(-3.0 + body.radius + ball.radius + 0.01, 3.0)
    assert client.result("SetEntityState", "1.x", entity="ball", state=ball_at) == OK
    near = None
    for _ in range(40):
        assert client.result("StepSimulation", steps=1) == OK
        near = client.call("/cyan2/kick", "touchline_msgs/srv/Kick", mode="ground", speed=5.0)
        if near["success"]:
            break
    assert client.result("StepSimulation", steps=5) == OK
    speed = client.simulation("GetEntityState", entity="ball")["state"]["twist"]["linear"]
    assert (speed["x"] ** 2 + speed["y"] ** 2) ** 0.5 > 3.0
    return far, near


def test_a_foreign_client_controls_a_match_of_nodes_and_its_recording_verifies(tmp_path: Path) -> None:
    (tmp_path / "match.toml").write_text(MATCH)
    with ExitStack() as stack:
        words = touchline("match", "match.toml", "--listen", "tcp/127.0.0.1:0")
        log = stack.enter_context(started(words, tmp_path, "match"))
        said_in(log, "(waiting for cyan)")
        words = touchline("ros2", "--match", "controlled", "--side", "cyan", "--control", "--listen", "tcp/127.0.0.1:0")
        at = graph_at(stack.enter_context(started(words, tmp_path, "ros2")))
        team = [sys.executable, "-W", "ignore", str(TEAM), "--dribble", "sdk", at, "cyan1", "cyan2"]
        words = [sys.executable, "-W", "ignore", str(CONTROL), at]
        foreign = stack.enter_context(subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True))
        stack.callback(foreign.terminate)
        client = Client(foreign)
        assert client.simulation("GetSimulatorFeatures")["features"]["features"]
        assert client.simulation("GetSimulationState")["state"]["state"] == PLAYING
        assert client.result("StepSimulation", steps=1) == FAILED
        assert client.result("SetSimulationState", state={"state": PAUSED}) == OK
        stack.enter_context(started(team, tmp_path, "team"))
        said_in(log, "(pauses the match)")
        assert client.result("StepSimulation", steps=START_TICK) == OK
        far, near = kicked(client)
        check_services(client)
        assert (far["success"], far["message"]) == (False, "the robot does not hold the ball")
        assert near["success"]
        assert client.result("SetSimulationState", state={"state": PLAYING}) == OK
        said_in(log, "(full time)")
        said_in(log, "(recording +runs)")
    (recording,) = tmp_path.glob("runs/*/match.mcap")
    kicks = [one.kick for _, one in open_recording(recording).decoded(COMMAND.fill(robot="cyan2")) if one.kick]
    assert {kick.speed for kick in kicks} == {5.0}
    assert verify(recording).identical
