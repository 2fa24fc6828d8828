"""Messages: closed, finite, frozen, versioned, and exact."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from schemas.game import ActionName, Phase, TeamPhase
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.game import RefereeAction
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.radio import Radio
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.messages.world import BallTruth, World
from schemas.side import Side
from schemas.topics import TOPICS
from schemas.wire.faults import FaultError
from schemas.wire.message import BadMessageError, Message

FINITE = st.floats(allow_nan=False, allow_infinity=False)


@pytest.mark.parametrize(
    ("payload", "reason"),
    [
        (b'{"version":"2.0","answers_tick":1,"drive":{"vx":NaN,"vy":0,"omega":0}}', "drive.vx"),
        (b'{"version":"2.0"}', "answers_tick is"),
        (b'{"version":"2.0","answers_ti', "not JSON"),
        (b"[]", "Command"),
        (b" " * 20_000, "20000 bytes, at most 12288"),
    ],
)
def test_a_bad_command_is_refused_in_one_line_that_names_what_is_wrong(payload: bytes, reason: str) -> None:
    with pytest.raises(BadMessageError) as error:
        Command.decode(payload)
    assert reason in str(error.value)
    assert "\n" not in str(error.value)


@given(FINITE, FINITE, FINITE)
def test_floats_cross_the_wire_bit_for_bit(x: float, y: float, z: float) -> None:
    world = World(tick=1, time=0.02, robots={}, ball=BallTruth(x=x, y=y, z=z, vx=0, vy=0, vz=0))
    ball = World.decode(world.encode()).ball
    assert [math.copysign(1, a) * a for a in (ball.x, ball.y, ball.z)] == [math.copysign(1, a) * a for a in (x, y, z)]


def test_a_radio_message_has_room_for_a_little_of_anything_and_no_more() -> None:
    assert Radio(extra={"plan": "press", "share": 0.5, "sure": True}).extra["plan"] == "press"
    with pytest.raises(FaultError):
        Radio(extra={f"key{n}": n for n in range(17)})
    with pytest.raises(FaultError):
        Radio(intention="x" * 81)


@pytest.mark.parametrize("name", TOPICS)
def test_every_message_has_a_json_schema(name: str) -> None:
    message = TOPICS[name].message
    if message is not None:
        assert json.dumps(message.json_schema())


def test_a_command_reads_as_in_the_protocol() -> None:
    command = Command(
        answers_tick=412, drive=Drive(vx=1.5, omega=0.3), dribble=True, kick=Kick(mode=KickMode.LOB, speed=8)
    )
    content = json.loads(command.encode())
    assert content["version"] == "2.0"
    assert content["kick"] == {"mode": "lob", "speed": 8.0}
    assert content["drive"] == {"vx": 1.5, "vy": 0.0, "omega": 0.3}


@pytest.mark.parametrize("side", Side)
def test_each_side_sees_its_own_restarts_as_its_own(side: Side) -> None:
    assert TeamPhase.of(Phase.THROW_IN, side, side) is TeamPhase.OUR_THROW_IN
    assert TeamPhase.of(Phase.THROW_IN, side, side.opponent) is TeamPhase.THEIR_THROW_IN
    assert TeamPhase.of(Phase.DROP_BALL, None, side) is TeamPhase.DROP_BALL
    assert TeamPhase.of(Phase.PENALTY, side, side).ours and TeamPhase.of(Phase.PENALTY, side, side.opponent).theirs


ASKED = (
    RefereeAction(action=ActionName.STOP),
    SceneRequest(operation=SceneOperation.RESET),
    ParametersRequest(operation=ParameterOperation.RESET),
)


@pytest.mark.parametrize("asked", ASKED, ids=lambda asked: type(asked).__name__)
@pytest.mark.parametrize("source", ["x" * 81, "coach\x1b[2J", "coach\nGOAL"])
def test_who_asks_is_named_in_one_short_line_that_no_terminal_obeys(asked: Message, source: str) -> None:
    """The host has it in the text of events, which people read on terminals."""
    payload = asked.model_copy(update={"source": source}).encode()
    with pytest.raises(BadMessageError, match="source is"):
        type(asked).decode(payload)
    told = asked.model_copy(update={"source": "coach program Ärger, [two]"})
    assert type(asked).decode(told.encode()) == told
