"""Messages: read, refused in one line, written bit for bit, constructed, and described."""

import json
import math
import pickle
from typing import Annotated, Any

import msgspec
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from message_examples import examples
from schemas.messages.applied import Applied, AppliedInput, OperatorChange
from schemas.messages.coach import ActiveOrder, CoachMode, CoachOrder, CoachTest
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.debug import Debug
from schemas.messages.manual import ManualDrive
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.radio import BallBelief, Motion, Radio
from schemas.messages.record_batch import BatchEntry
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.messages.sight import Obstacle, Sight
from schemas.messages.soccer.game import GameEvent, RefereeAction
from schemas.messages.world import BallTruth, World
from schemas.side import Side
from schemas.soccer.game import ActionName, Phase, Point, TeamPhase
from schemas.topics import TOPICS
from schemas.wire.faults import FaultError
from schemas.wire.message import BadMessageError, Message
from schemas.wire.part import Part, decoder, encode

SIGHT = examples()[Sight]
PAYLOAD = SIGHT.encode()

VALUES = st.sampled_from(
    (
        b"0",
        b"-0.0",
        b"1e999",
        b"NaN",
        b"true",
        b"null",
        b'""',
        b'"x\\n"',
        b'"\\ud800"',
        b'"cyan1"',
        b"[]",
        b"{}",
        b"3.0",
        b"7",
        b"1" * 5000,
    )
)

FINITE = st.floats(allow_nan=False, allow_infinity=False)
NUMBERS = st.floats(-1e300, 1e300)
DRIVES = st.builds(Drive, vx=st.floats(-20.0, 20.0), vy=st.floats(-20.0, 20.0), omega=st.floats(-50.0, 50.0))
KICKS = st.builds(Kick, mode=st.sampled_from(KickMode), speed=st.floats(1e-9, 40.0))
MOTIONS = st.builds(Motion, x=NUMBERS, y=NUMBERS, heading=NUMBERS, vx=NUMBERS, omega=NUMBERS)
RADIOS = st.builds(
    Radio,
    self=st.none() | MOTIONS,
    ball=st.none() | st.builds(BallBelief, x=NUMBERS, y=NUMBERS, vx=NUMBERS, age=st.floats(0.0, 1e17)),
    role=st.none() | st.sampled_from(("", "role1", "1e5", "ü\n")),
    pass_to=st.none() | st.just("cyan4"),
    extra=st.dictionaries(st.text(max_size=5), st.booleans() | st.integers(-9, 9) | NUMBERS, max_size=3),
)
COMMANDS = st.builds(
    Command,
    answers_tick=st.integers(0, 10**6),
    drive=DRIVES,
    dribble=st.booleans(),
    kick=st.none() | KICKS,
    radio=st.none() | RADIOS,
    acknowledges_order=st.none() | st.integers(0, 9),
)


def refused(read: Any, payload: bytes) -> str:
    """Why a payload is refused, in one line; nothing where it is read."""
    try:
        read(payload)
    except BadMessageError as error:
        assert "\n" not in str(error) and " at 0x" not in str(error) and "$" not in str(error)
        return str(error)
    return ""


@given(COMMANDS)
@example(Command(answers_tick=0, radio=Radio(self=Motion(x=1e16, y=-0.0, heading=0.0), role="1e5")))
def test_what_is_written_is_read_back_equal(command: Command) -> None:
    again = Command.decode(command.encode())
    assert again == command and again.encode() == command.encode()
    assert isinstance(again, Command) and isinstance(again.drive, Drive)


@pytest.mark.parametrize("kind", examples(), ids=lambda kind: kind.__name__)
def test_a_message_is_read_back_equal_and_immutable(kind: type[Message]) -> None:
    message = examples()[kind]
    again = kind.decode(message.encode())
    assert type(again) is kind and again == message and pickle.loads(pickle.dumps(again)) == message
    assert repr(again).startswith(f"{kind.__name__}(")
    with pytest.raises(AttributeError):
        again.version = "1.1"  # type: ignore[misc]
    assert again.replace(version="1.1") != again


@given(st.data())
def test_a_payload_with_other_bytes_is_a_sight_or_no_message(data: st.DataObject) -> None:
    payload = bytearray(PAYLOAD)
    at = data.draw(st.integers(0, len(payload) - 1))
    payload[at : at + data.draw(st.integers(0, 3))] = data.draw(st.binary(max_size=3))
    refused(Sight.decode, bytes(payload))


@given(st.data(), VALUES)
def test_a_field_that_holds_something_else_is_read_or_named(data: st.DataObject, value: bytes) -> None:
    def places(content: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
        below = (
            content.items() if isinstance(content, dict) else enumerate(content) if isinstance(content, list) else ()
        )
        return [path, *[place for key, item in below for place in places(item, (*path, key))]]

    content: Any = json.loads(PAYLOAD)
    *way, last = data.draw(st.sampled_from(places(content)[1:]))
    inner = content
    for step in way:
        inner = inner[step]
    inner[last] = "HERE"
    reason = refused(Sight.decode, json.dumps(content).encode().replace(b'"HERE"', value))
    path = ".".join(str(step) for step in (*way, last))
    assert reason == "" or path in reason or "not JSON" in reason or "version" in reason


@pytest.mark.parametrize(
    "payload",
    [b"", b"[]", b"\x00\xff", b" " * 70_000, b"[" * 60_000, PAYLOAD[:-1], PAYLOAD + b"x", b"3", b'{"tick":' * 9_000],
    ids=lambda payload: repr(payload[:9]),
)
def test_what_is_no_sight_is_refused_in_one_line(payload: bytes) -> None:
    assert refused(Sight.decode, payload).startswith("Sight: ")


def test_versions_are_distinguished_by_their_major_number() -> None:
    assert Sight.decode(PAYLOAD.replace(b'"version":"2.0"', b'"version":"2.7"')).version == "2.7"
    sentence = "Sight: version 1.0 is not supported, this side has 2.0; update the older side"
    assert refused(Sight.decode, PAYLOAD.replace(b'"version":"2.0"', b'"version":"1.0"')) == sentence
    assert refused(Sight.decode, b'{"version":"1.0","brand_new":1}') == sentence


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ({"drive": {"vx": "fast"}}, "drive.vx is 'fast'; m/s from -20 to 20"),
        ({"drive": {"vx": True}}, "drive.vx is True; m/s from -20 to 20"),
        ({"answers_tick": -1}, "answers_tick is -1; a whole number from 0"),
        ({"answers_tick": 3.5}, "answers_tick is 3.5; a whole number from 0"),
        ({"kick": {"mode": "banana", "speed": 3}}, "kick.mode is 'banana'; one of ground, lob, loft"),
        ({"kick": {"mode": "lob"}}, "kick.speed is missing; it must be given"),
        ({"kick": {"mode": "lob", "speed": 0}}, "kick.speed is 0; m/s above 0, at most 40"),
        ({"dribble": None}, "dribble is None; true or false"),
        ({"drive": []}, "drive is []; an object"),
        ({"radio": {"role": "x" * 81}}, "; text of at most 80 characters"),
        ({"radio": {"pass_to": "cyan4\n"}}, "radio.pass_to is 'cyan4\\n'; lower-case letters, digits and _"),
        ({"radio": {"extra": {"plan": []}}}, "radio.extra.plan is []; a finite number or true or false or text"),
        ({"radio": {"ball": {"x": 1, "y": 2, "age": -1}}}, "radio.ball.age is -1; s from 0"),
        ({"drive": {"vx": math.nan}}, "drive.vx is nan; m/s from -20 to 20"),
        ({"drive": {"vx": 1e300}}, "drive.vx is 1e+300; m/s from -20 to 20"),
        ({"answers_tick": None}, "answers_tick is None; a whole number from 0"),
        ({"drivel": {}}, 'drivel is not known; did you mean "drive"?'),
    ],
)
def test_a_refusal_names_field_value_and_expectation(content: dict[str, Any], said: str) -> None:
    payload = json.dumps({"answers_tick": 1, **content}).encode()
    assert said in refused(Command.decode, payload)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 20.5, "1", None])
def test_a_part_that_a_brain_makes_is_checked_where_it_is_made(value: Any) -> None:
    with pytest.raises(FaultError, match=r"drive\.vy is .*; m/s from -20 to 20"):
        Drive(vy=value)


def test_a_part_that_is_not_checked_alone_is_checked_in_its_message() -> None:
    with pytest.raises(FaultError, match=r"radio\.self\.heading is nan; a finite number in rad"):
        Radio(self=Motion(x=0.0, y=0.0, heading=math.nan))
    with pytest.raises(FaultError, match=r"radio\.extra\.share is inf"):
        Radio(extra={"share": math.inf})
    with pytest.raises(FaultError, match=r"ball_belief\.age is -1\.0; s from 0"):
        BallBelief(x=0.0, y=0.0, age=-1.0)
    with pytest.raises(FaultError, match=r"coach_order\.point_a\.x is nan"):
        CoachOrder(sequence=1, point_a=Point(x=math.nan, y=0.0))


def test_texts_of_other_libraries_and_of_enumerations_become_plain_ones() -> None:
    class Text(str):
        __slots__ = ()

    for text in (np.str_("lob"), KickMode.LOB):
        command = Command(answers_tick=1, refuses_order=text, debug=Debug(values={"plan": text}))
        assert type(command.refuses_order) is str
        assert Command.decode(command.encode()).debug.values == {"plan": "lob"}
    with pytest.raises(FaultError):
        Command(answers_tick=1, refuses_order=Text("lob"))


def test_what_was_changed_without_a_check_is_refused_where_it_enters() -> None:
    command = Command(answers_tick=1).replace(drive=Drive().replace(vx=21.0))
    assert "drive.vx is 21.0; m/s from -20 to 20" in refused(Command.decode, command.encode())


def test_numbers_of_other_libraries_and_words_of_enumerations_are_taken_for_what_they_are() -> None:
    drive = Drive(vx=np.float64(1.5), vy=np.float32(0.5), omega=2)
    assert drive == Drive(vx=1.5, vy=0.5, omega=2.0) and type(drive.vx) is type(drive.omega) is float
    kick = Kick(mode="lob", speed=np.int64(8))  # type: ignore[arg-type]
    command = Command(answers_tick=np.int64(3), dribble=np.bool_(True), kick=kick)
    assert command.encode() == Command(answers_tick=3, dribble=True, kick=Kick(mode=KickMode.LOB, speed=8.0)).encode()


def test_a_rule_over_several_fields_holds_where_an_order_is_made_and_read() -> None:
    with pytest.raises(FaultError, match=r"^the mode test needs a test"):
        CoachOrder(sequence=1, mode=CoachMode.TEST)
    with pytest.raises(FaultError, match=r"^the mode hold has no test"):
        CoachOrder(sequence=1, mode=CoachMode.HOLD, test=CoachTest.STOP)
    assert "the mode test needs a test" in refused(CoachOrder.decode, b'{"sequence":1,"mode":"test"}')
    order = msgspec.to_builtins(CoachOrder(sequence=1))
    sight = json.loads(PAYLOAD) | {"order": {**order, "mode": "test"}}
    assert "order: the mode test needs a test" in refused(Sight.decode, json.dumps(sight).encode())


def test_a_word_leaves_out_what_is_null_or_empty() -> None:
    assert msgspec.json.encode(Radio(role="keeper")) == b'{"role":"keeper"}'
    assert msgspec.json.encode(Radio()) == b"{}"


@pytest.mark.parametrize(
    ("kind", "change", "said"),
    [
        (ManualDrive, {"drive": {"vx": 30}}, "ManualDrive: drive.vx is 30; m/s from -20 to 20"),
        (GameEvent, {"place": {"x": math.nan, "y": 0}}, "GameEvent: place.x is nan; a finite number in m"),
        (GameEvent, {"place": {"x": 0}}, "GameEvent: place.y is missing; it must be given"),
        (GameEvent, {"side": "red"}, "GameEvent: side is 'red'; one of cyan, magenta"),
        (GameEvent, {"tcik": 3}, 'GameEvent: tcik is not known; did you mean "tick"?'),
        (GameEvent, {"score": {"cyan": -1}}, "GameEvent: score.cyan is -1; a whole number from 0"),
        (ActiveOrder, {"order": {"sequence": 1, "mode": "test"}}, "ActiveOrder: order: the mode test needs a test"),
        (Applied, {"inputs": {"cyan1": {"drive": {"vy": 99}, "dribble": False}}}, "inputs.cyan1.drive.vy is 99; m/s"),
    ],
)
def test_a_fault_of_a_part_is_named_from_the_outside(kind: type[Message], change: dict[str, Any], said: str) -> None:
    payload = json.dumps(json.loads(examples()[kind].encode()) | change).encode()
    assert said in refused(kind.decode, payload)


def references(schema: Any) -> set[str]:
    """Everything that a schema refers to."""
    match schema:
        case dict():
            own = {schema["$ref"]} if isinstance(schema.get("$ref"), str) else set()
            return own.union(*[references(value) for value in schema.values()])
        case list():
            return set[str]().union(*[references(value) for value in schema])
    return set()


@pytest.mark.parametrize("name", TOPICS)
def test_a_schema_has_all_that_it_refers_to_in_one_list(name: str) -> None:
    for kind in (TOPICS[name].message, TOPICS[name].reply):
        if kind is not None:
            schema = kind.json_schema()
            known = {f"#/$defs/{name}" for name in schema.get("$defs", {})}
            assert references(schema) <= known
            assert "$defs" not in json.dumps({key: value for key, value in schema.items() if key != "$defs"}).replace(
                "#/$defs/", ""
            )
            assert schema["type"] == "object" and schema["title"] == kind.__name__


def test_a_part_is_described_alike_alone_and_in_a_message() -> None:
    alone, within = CoachOrder.json_schema(), ActiveOrder.json_schema()
    definitions = alone.pop("$defs")
    assert within["$defs"] == {"CoachOrder": alone, **definitions}
    assert alone["properties"]["radius"]["anyOf"][0] == {"type": "number", "exclusiveMinimum": 0, "maximum": 20}
    assert alone["properties"]["robot_a"]["anyOf"][0]["pattern"] == "^[a-z][a-z0-9_]*$"


def below(kind: type[Part]) -> set[type[Part]]:
    """A part and all that extend it."""
    return {kind}.union(*[below(one) for one in kind.__subclasses__()])


def test_every_default_is_valid() -> None:
    checked = 0
    for kind in below(Part):
        for field in msgspec.structs.fields(kind):
            if field.required:
                continue
            value = field.default_factory() if field.default is msgspec.NODEFAULT else field.default
            assert decoder(field.type).decode(encode(value)) == value, f"{kind.__name__}.{field.name}"
            checked += 1
    assert checked > 20


def test_every_part_is_frozen_closed_and_made_by_keywords() -> None:
    for kind in below(Part) - {Part, AppliedInput, BatchEntry, OperatorChange, Obstacle}:
        config = kind.__struct_config__
        assert config.frozen and config.forbid_unknown_fields and not config.gc
        with pytest.raises(TypeError):
            kind(1)


class Limited(Message):
    """Every limit that a field may have."""

    low: Annotated[int, msgspec.Meta(ge=1, lt=4)] = 1
    high: Annotated[float, msgspec.Meta(gt=0, le=2)] | None = None
    word: Annotated[str, msgspec.Meta(pattern=r"^a+\Z", min_length=2, max_length=3)] = "aa"
    few: Annotated[list[int], msgspec.Meta(max_length=2)] = []


@given(
    st.integers(-1, 5), st.none() | st.floats(-1, 3), st.text("ab\n", max_size=4), st.lists(st.integers(), max_size=3)
)
@example(3, 2.0, "aa\n", [])
def test_limits_hold(low: int, high: float | None, word: str, few: list[int]) -> None:
    payload = json.dumps({"low": low, "high": high, "word": word, "few": few}).encode()
    is_sound = 1 <= low < 4 and (high is None or 0 < high <= 2) and word in ("aa", "aaa") and len(few) <= 2
    assert (refused(Limited.decode, payload) == "") == is_sound


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
    payload = asked.replace(source=source).encode()
    with pytest.raises(BadMessageError, match="source is"):
        type(asked).decode(payload)
    told = asked.replace(source="coach program Ärger, [two]")
    assert type(asked).decode(told.encode()) == told
