"""Light readers: structs with the fields of a model, which the model itself would have read from the same payload."""

import dataclasses
import json
from collections.abc import Callable
from enum import Enum
from typing import Annotated, Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from pydantic import Field, StringConstraints
from pydantic_core import to_json

from schemas.game import DisciplinaryRecord, GameState
from schemas.message import BadMessageError, Message
from schemas.messages.coach import CoachMode, CoachOrder
from schemas.messages.command import BallBelief, Command, Drive, Kick, KickMode, Motion, Radio
from schemas.messages.host import Applied, AppliedInput
from schemas.messages.light import (
    beyond_defaults,
    light_encode,
    light_encode_exactly,
    light_form,
    light_reader,
)
from schemas.messages.sight import Sight
from schemas.messages.world import World
from schemas.protocol.examples import examples

SIGHT = examples()[Sight]
PAYLOAD = SIGHT.encode()
READ = light_reader(Sight)

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
    )
)


def plain(thing: Any) -> Any:
    """The fields of a message or a part, light or not, down to plain values."""
    match thing:
        case Enum():
            return thing.value
        case list() | tuple():
            return [plain(item) for item in thing]
        case dict():
            return {key: plain(item) for key, item in thing.items()}
        case None | bool() | int() | float() | str():
            return (type(thing).__name__, thing)
    names = getattr(type(thing), "model_fields", None) or thing.__struct_fields__
    return {name: plain(getattr(thing, name)) for name in names}


def said_of(read: Callable[[bytes], Any], payload: bytes) -> Any:
    """What comes of a payload: its content, or why it is refused."""
    try:
        return plain(read(payload))
    except BadMessageError as error:
        return str(error)


def test_a_light_sight_has_the_fields_of_a_sight_and_is_none() -> None:
    sight = READ(PAYLOAD)
    assert plain(sight) == plain(SIGHT)
    assert not isinstance(sight, Sight)
    assert str(sight.ball).startswith("BallSight(x=")


@given(st.data())
def test_what_a_light_reader_makes_of_any_payload_is_what_the_model_makes_of_it(data: st.DataObject) -> None:
    payload = bytearray(PAYLOAD)
    at = data.draw(st.integers(0, len(payload) - 1))
    payload[at : at + data.draw(st.integers(0, 3))] = data.draw(st.binary(max_size=3))
    assert said_of(READ, bytes(payload)) == said_of(Sight.decode, bytes(payload))


@given(st.data(), VALUES)
def test_a_field_that_holds_something_else_is_read_or_refused_as_the_model_does(
    data: st.DataObject, value: bytes
) -> None:
    def places(content: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
        below = (
            content.items() if isinstance(content, dict) else enumerate(content) if isinstance(content, list) else ()
        )
        return [path, *[place for key, item in below for place in places(item, (*path, key))]]

    content: Any = {"sight": json.loads(PAYLOAD)}
    *way, last = data.draw(st.sampled_from(places(content)[2:]))
    inner = content
    for step in way:
        inner = inner[step]
    if data.draw(st.booleans()) or not isinstance(inner, dict):
        inner[last] = "HERE"
    else:
        inner["HERE" if data.draw(st.booleans()) else "cyan4\n"] = inner.pop(last)
    payload = json.dumps(content["sight"]).encode().replace(b'"HERE":', b'"here":').replace(b'"HERE"', value)
    assert said_of(READ, payload) == said_of(Sight.decode, payload)


@pytest.mark.parametrize(
    "payload",
    [b"", b"[]", b"\x00\xff", b" " * 70_000, b"[" * 60_000, PAYLOAD[:-1], PAYLOAD + b"x", b'{"version":"2.3"}'],
    ids=repr,
)
def test_what_is_no_sight_is_refused_with_the_models_reason(payload: bytes) -> None:
    with pytest.raises(BadMessageError) as light:
        READ(payload)
    with pytest.raises(BadMessageError) as whole:
        Sight.decode(payload)
    assert str(light.value) == str(whole.value)


def test_a_newer_minor_version_is_read() -> None:
    newer = PAYLOAD.replace(b'"version":"1.0"', b'"version":"1.7"')
    assert newer != PAYLOAD
    assert plain(READ(newer)) == plain(Sight.decode(newer))


def test_what_was_read_is_never_changed() -> None:
    with pytest.raises(AttributeError):
        READ(PAYLOAD).tick = 3  # type: ignore[misc]


def test_the_fields_of_a_light_part_make_a_dict_as_those_of_a_model_do() -> None:
    assert dict(READ(PAYLOAD).self) == dict(SIGHT.self)


def test_a_light_part_can_stand_in_a_message() -> None:
    sight = READ(PAYLOAD)
    said = Command.decode(Command(answers_tick=sight.tick, radio=Radio(self=sight.self)).encode()).radio
    assert said is not None and said.self == SIGHT.self
    assert isinstance(said.self, Motion)


def test_a_part_with_rules_of_its_own_stays_what_it_is() -> None:
    order = CoachOrder(sequence=3, mode=CoachMode.HOLD)
    sight = READ(SIGHT.model_copy(update={"order": order}).encode())
    assert sight.order == order
    broken = SIGHT.model_copy(update={"order": order.model_copy(update={"mode": CoachMode.TEST})}).encode()
    with pytest.raises(BadMessageError, match="needs a test"):
        READ(broken)


@pytest.mark.parametrize("kind", [Sight, Command, World, GameState], ids=lambda kind: kind.__name__)
def test_every_message_that_comes_once_a_tick_can_be_read_light(kind: type[Message]) -> None:
    message = examples()[kind]
    assert plain(light_reader(kind)(message.encode())) == plain(kind.decode(message.encode()))


class Limited(Message):
    """Every limit that a model may have."""

    low: Annotated[int, Field(ge=1, lt=4)] = 1
    high: Annotated[float, Field(gt=0, le=2)] | None = None
    word: Annotated[str, StringConstraints(pattern="^a+$", min_length=2, max_length=3)] = "aa"
    few: Annotated[list[int], Field(max_length=2)] = Field(default_factory=list)
    standing: DisciplinaryRecord = DisciplinaryRecord(red=1)


@given(
    st.integers(-1, 5), st.none() | st.floats(-1, 3), st.text("ab\n", max_size=4), st.lists(st.integers(), max_size=3)
)
@example(3, 2.0, "aa\n", [])
def test_limits_are_those_of_the_model(low: int, high: float | None, word: str, few: list[int]) -> None:
    payload = json.dumps({"low": low, "high": high, "word": word, "few": few}).encode()
    assert said_of(light_reader(Limited), payload) == said_of(Limited.decode, payload)


def test_what_a_struct_would_read_otherwise_is_refused_when_the_reader_is_made() -> None:
    class Odd(Message):
        even: Annotated[int, Field(multiple_of=2)] = 2

    with pytest.raises(TypeError, match="no limit that a struct knows"):
        light_reader(Odd)
    with pytest.raises(TypeError, match="AppliedInput"):
        light_reader(Applied)


DRIVES = st.builds(Drive, vx=st.floats(-20.0, 20.0), vy=st.floats(-20.0, 20.0), omega=st.floats(-50.0, 50.0))
KICKS = st.builds(Kick, mode=st.sampled_from(KickMode), speed=st.floats(1e-9, 40.0))
PLACES = st.floats(-1e15, 1e15)
WORDS = st.builds(
    Radio,
    self=st.none() | st.builds(Motion, x=PLACES, y=PLACES, heading=PLACES),
    role=st.none() | st.text(max_size=20),
    extra=st.dictionaries(st.text(max_size=5), st.booleans() | st.integers(-9, 9) | PLACES, max_size=3),
)


@given(
    st.integers(0, 10**6), DRIVES, st.booleans(), st.none() | KICKS, st.none() | WORDS, st.none() | st.integers(0, 9)
)
def test_a_light_command_is_encoded_as_the_command_with_the_same_fields(tick, drive, dribble, kick, radio, order):
    fields = {
        "answers_tick": tick,
        "drive": drive,
        "dribble": dribble,
        "kick": kick,
        "radio": radio,
        "acknowledges_order": order,
    }
    light, heavy = light_form(Command)(**fields), Command(**fields)
    assert light.encode() == heavy.encode()
    assert dict(light) == dict(heavy)
    assert Command.model_validate(light) == heavy


@given(DRIVES, st.booleans(), st.none() | KICKS, st.none() | st.integers(0, 10**6))
def test_a_light_dataclass_is_written_as_the_dataclass(drive, dribble, kick, tick):
    light, heavy = light_form(AppliedInput)(drive, dribble, kick, tick), AppliedInput(drive, dribble, kick, tick)
    assert light_encode({"cyan1": light}) == to_json({"cyan1": heavy})
    assert dict(light) == {one.name: getattr(heavy, one.name) for one in dataclasses.fields(heavy)}
    rest = light_form(AppliedInput)(drive, dribble=dribble)
    assert (rest.kick, rest.answers_tick) == (None, None)


def test_a_light_message_never_changes():
    with pytest.raises(AttributeError):
        light_form(Command)(answers_tick=1).dribble = True


NUMBERS = st.sampled_from((0.0, -0.0, 1e15, 1e16, -1.5e16, 1e300, 1e-7)) | st.floats(-1e300, 1e300)
LOUD_WORDS = st.builds(
    Radio,
    self=st.none() | st.builds(Motion, x=NUMBERS, y=NUMBERS, heading=NUMBERS, vx=NUMBERS, omega=NUMBERS),
    ball=st.none() | st.builds(BallBelief, x=NUMBERS, y=NUMBERS, vx=NUMBERS, age=st.just(0.0) | st.floats(0.0, 1e17)),
    role=st.none() | st.sampled_from(("", "role1", "1e5", "ü\n")),
    pass_to=st.none() | st.just("cyan4"),
    extra=st.dictionaries(st.text(max_size=5), st.booleans() | st.integers() | NUMBERS | st.text(), max_size=3),
)


@given(LOUD_WORDS)
@example(Radio())
@example(Radio(self=Motion(x=1e16, y=0.0, heading=0.0), role="1e5"))
def test_a_word_is_written_to_the_byte_as_the_model_writes_it_light_or_not(word: Radio) -> None:
    light = light_reader(Command)(Command(answers_tick=0, radio=word).encode()).radio
    for one in (word, light):
        assert one is not None
        assert light_encode_exactly({"radio": one}) == to_json({"radio": word})
        terse = word.model_dump_json(exclude_defaults=True).encode()
        assert light_encode_exactly(beyond_defaults(one)) == terse


def test_a_part_that_is_its_default_is_nothing_beyond_the_defaults() -> None:
    for read in (Command.decode, light_reader(Command)):
        assert beyond_defaults(read(Command(answers_tick=7).encode())) == {"answers_tick": 7}
        turns = Command(answers_tick=7, drive=Drive(omega=2.0)).encode()
        assert beyond_defaults(read(turns)) == {"answers_tick": 7, "drive": {"omega": 2.0}}
