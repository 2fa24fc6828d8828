"""A match simulated again from its notes alone, from tick 0 and from every checkpoint, bit for bit."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from msgspec.structs import replace
from pydantic_core import from_json

from schemas.config.match_config import load_match
from schemas.config.obstacle import ObstacleConfig, Shape
from schemas.config.roster import Placement
from schemas.messages.applied import Applied, AppliedInput, chained_part_of
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.messages.world import World
from schemas.wire.message import VERSION
from schemas.wire.part import encode
from sim_host.match.live_parameters import LiveParameters
from sim_host.match.resimulation import CheckpointState, Conditions, ImpossibleTickError, Resimulation, parameters_of
from sim_host.match.simulation import Simulation, TickResult
from sim_host.match.world_difference import Difference, differences
from sim_host.soccer.game import ARENA

CRATE = {"name": "crate", "shape": "box", "place": [1.5, 1.0], "heading": 0.4, "size": [0.4, 0.8, 0.6]}
KINDS: dict[str, dict[str, Any]] = {
    "velocity drive": {},
    "wheels": {"profile": "omni"},
    "two wheels": {"profile": "differential"},
    "the paper's robots": {"profile": "paper"},
    "dribble by velocity": {"types": {"own": {"dribble": {"method": "velocity"}}}},
    "dribble by force": {
        "types": {
            "own": {
                "dribble": {"method": "force", "stiffness": 200.0, "damping": 8.0, "max_pull": 8.0, "max_side": 4.0}
            }
        }
    },
    "types and obstacles": {"types": {"own": {"drive": {"model": "omni"}}}, "obstacles": [CRATE]},
}

OTHER_KINDS = ("wheels", "dribble by velocity")
"""Parts of them are in the others: wheels in "types and obstacles", the velocity in a dribble by force."""


def lively(simulation: Simulation) -> dict[str, Command]:
    """The nearest is after the ball, dribbles, and now and then kicks, along the ground or up; the others run about."""
    now, said = simulation.world.snapshot(), {}
    away = [math.hypot(now.ball.x - robot.x, now.ball.y - robot.y) for robot in now.robots]
    for place, (name, robot) in enumerate(zip(now.roster.names, now.robots, strict=True)):
        dx, dy = now.ball.x - robot.x, now.ball.y - robot.y
        bearing = math.remainder(math.atan2(dy, dx) - robot.heading, 2 * math.pi)
        if away[place] > min(away):
            drive = Drive(vx=1.0 + 0.2 * place, vy=math.sin(now.tick / 9), omega=0.4 * place)
        elif now.possession == name:
            drive = Drive(vx=1.5, omega=0.8)
        else:
            speed = min(3.0, 2.0 * away[place])
            drive = Drive(vx=speed * math.cos(bearing), vy=speed * math.sin(bearing), omega=4.0 * bearing)
        mode = KickMode.LOFT if now.tick % 3 else KickMode.GROUND
        kicks = now.possession == name and now.tick % 20 == 0
        kick = Kick(mode=mode, speed=3.0) if kicks else None
        said[name] = Command(answers_tick=now.tick, drive=drive, dribble=away[place] < 1.5, kick=kick)
    return said


def operated(simulation: Simulation, number: int) -> None:
    """An operator's deed that makes a checkpoint in the middle of play."""
    operations: list[Callable[[], Any]] = [
        lambda: simulation.handle_scene(
            SceneRequest(operation=SceneOperation.PLACE, place=[Placement(body="magenta1", x=9.0, y=4.0, heading=0.3)])
        ),
        lambda: simulation.handle_parameters(
            ParametersRequest(
                operation=ParameterOperation.SET, values={"ball.rolling_deceleration": 0.5 + 0.1 * number}
            )
        ),
        lambda: simulation.handle_scene(
            SceneRequest(
                operation=SceneOperation.ADD,
                obstacles=[POST.model_copy(update={"name": f"post{number}", "place": [3.0 + number, -3.0]})],
            )
        ),
    ]
    assert operations[number % len(operations)]().accepted


POST = ObstacleConfig(name="post", shape=Shape.CYLINDER, place=[0.0, 0.0], radius=0.15, height=0.9)


@pytest.fixture(
    scope="module",
    params=[pytest.param(kind, marks=pytest.mark.long if name in OTHER_KINDS else ()) for name, kind in KINDS.items()],
    ids=KINDS,
)
def recorded(request) -> Iterator[tuple[Simulation, list[TickResult]]]:
    """A lively game of three a side with six checkpoints in the middle of it."""
    teams = {f"teams.{side}.size": 3 for side in ("cyan", "magenta")}
    about = {key: value for key, value in request.param.items() if key != "types"}
    if "types" in request.param:
        changes = {
            key: {name: {"value": value, "unit": UNITS.get(name, "N"), "origin": "test"} for name, value in own.items()}
            for key, own in request.param["types"]["own"].items()
        }
        about |= {"types": {"own": changes}, "teams.cyan.types": {"cyan2": "own", "cyan3": "own"}}
    simulation = Simulation(load_match(None, {"duration": 600.0, "referee.automatic": False, **teams, **about}))
    ticks = [simulation.now]
    for number in range(6):
        ticks += [simulation.step(lively(simulation)) for _ in range(45)]
        operated(simulation, number)
    ticks += [simulation.step(lively(simulation)) for _ in range(45)]
    yield simulation, ticks
    simulation.close()


UNITS = {"method": "", "model": "", "stiffness": "N/m", "damping": "N·s/m"}


def notes(ticks: list[TickResult]) -> list[tuple[Applied, bytes]]:
    return [(Applied.decode(tick.applied_encoded), chained_part_of(tick.applied_encoded)) for tick in ticks]


def world_of(tick: TickResult) -> World:
    """As it is read from a recording."""
    return World.decode(encode({"version": VERSION, **tick.world}))


def fields_of(tick: TickResult) -> dict[str, Any]:
    fields: dict[str, Any] = from_json(encode(tick.world))
    return fields


@pytest.mark.slow
def test_from_tick_0_every_tick_comes_out_the_same_with_all_that_the_world_tells(recorded) -> None:
    simulation, ticks = recorded
    again = Resimulation(ARENA, Conditions(LiveParameters.of(simulation.config)))
    kicks = holds = 0
    for tick, (applied, said) in zip(ticks, notes(ticks), strict=True):
        came = again.step(applied, said)
        assert came.chain == applied.chain, f"tick {applied.tick}"
        assert differences(fields_of(tick), came.bodies) == []
        kicks += "kicked" in came.bodies
        holds += came.bodies["possession"] is not None
    again.close()
    assert kicks >= 2 and holds >= 10, f"{kicks} kicks, {holds} holds"


@pytest.mark.slow
def test_from_every_checkpoint_it_does_so_too(recorded) -> None:
    """Kicker charge, wheel speeds, spin, a held or kicked ball: none of it is needed at a checkpoint."""
    simulation, ticks = recorded
    told = notes(ticks)
    starts = [applied.tick for applied, _ in told if applied.checkpoint and applied.tick > 0]
    assert len(starts) == 6
    for start in starts:
        conditions = Conditions(LiveParameters.of(simulation.config))
        for applied, _ in told[:start]:
            conditions = conditions.after(applied)
        again = Resimulation(ARENA, conditions, CheckpointState(world_of(ticks[start - 1]), told[start - 1][0].chain))
        for tick, (applied, said) in list(zip(ticks, told, strict=True))[start : start + 60]:
            came = again.step(applied, said)
            assert differences(fields_of(tick), came.bodies) == []
            assert came.chain == applied.chain, f"from {start}: tick {applied.tick}"
        again.close()


def test_the_hosts_words_on_its_setup_are_enough_for_the_numbers(recorded) -> None:
    simulation, ticks = recorded
    assert simulation.handle_parameters(ParametersRequest(operation=ParameterOperation.RESET)).accepted
    again = Resimulation(ARENA, Conditions(parameters_of(type(simulation.setup()).decode(simulation.setup().encode()))))
    for applied, said in notes(ticks):
        assert again.step(applied, said).chain == applied.chain
    again.close()


@pytest.fixture(scope="module")
def plain() -> Iterator[tuple[Simulation, list[TickResult]]]:
    simulation = Simulation(load_match(None, {"duration": 600.0, "teams.cyan.size": 2, "teams.magenta.size": 1}))
    ticks = [simulation.now, *(simulation.step(lively(simulation)) for _ in range(40))]
    yield simulation, ticks
    simulation.close()


def first_different(simulation: Simulation, told: list[tuple[Applied, bytes]]) -> int | None:
    again = Resimulation(ARENA, Conditions(LiveParameters.of(simulation.config)))
    try:
        for applied, said in told:
            if again.step(applied, said).chain != applied.chain:
                return applied.tick
    finally:
        again.close()
    return None


def edited(plain, tick: int, change: Callable[[AppliedInput], AppliedInput]) -> list[tuple[Applied, bytes]]:
    """The notes with another input of cyan2 in one tick, written again as a host writes."""
    _, ticks = plain
    told = notes(ticks)
    applied = told[tick][0]
    inputs = {**applied.inputs, "cyan2": change(applied.inputs["cyan2"])}
    fields = {**from_json(ticks[tick].applied_encoded), "inputs": inputs}
    payload = encode(fields)
    told[tick] = (applied.replace(inputs=inputs), chained_part_of(payload))
    return told


def ulp(one: AppliedInput) -> AppliedInput:
    return replace(one, drive=replace(one.drive, vx=math.nextafter(one.drive.vx, 9.0)))


@pytest.mark.parametrize("tick", [1, 17, 40])
def test_one_bit_of_one_command_is_found_at_its_tick(plain, tick) -> None:
    assert first_different(plain[0], notes(plain[1])) is None
    assert first_different(plain[0], edited(plain, tick, ulp)) == tick


def test_an_input_without_any_effect_is_found_too(plain) -> None:
    """The chain takes in the note: a dribbler far from the ball, the sight that a command answers."""
    assert first_different(plain[0], edited(plain, 9, lambda one: replace(one, dribble=not one.dribble))) == 9
    assert first_different(plain[0], edited(plain, 9, lambda one: replace(one, answers_tick=3))) == 9


IMPOSSIBLE: dict[str, tuple[dict[str, Any], str]] = {
    "an input is missing": ({"inputs": {}}, "inputs do not match the robots that take part: cyan1, cyan2, magenta1"),
    "a stranger is placed": ({"placements": [Placement(body="nobody", x=0, y=0)]}, "nobody is placed"),
    "a parameter that nobody knows": ({"parameters": {"ball.colour": 3.0}}, "parameters that cannot be set"),
    "nobody is left": ({"robots": [], "remade": True}, "no robot takes part"),
}


@pytest.mark.parametrize("change, said", IMPOSSIBLE.values(), ids=IMPOSSIBLE)
def test_impossible_inputs_are_reported_in_one_sentence(plain, change, said) -> None:
    told = notes(plain[1])
    again = Resimulation(ARENA, Conditions(LiveParameters.of(plain[0].config)))
    for applied, payload in told[:5]:
        again.step(applied, payload)
    with pytest.raises(ImpossibleTickError, match=said):
        again.step(told[5][0].replace(**change), told[5][1])
    again.close()


def test_what_differs_is_named_by_body_and_field_and_by_how_much() -> None:
    robot = {"x": 1.0, "y": 2.0, "holding": False}
    world = {"tick": 3, "time": 0.06, "possession": None, "ball": {"x": 0.0}}
    ours = {**world, "robots": {"cyan1": robot}, "touches": ["cyan1"]}
    theirs = {**world, "robots": {"cyan1": {**robot, "x": 1.25, "holding": True}}, "possession": "cyan1"}
    found = differences(theirs, ours)
    assert found == [
        Difference("cyan1", "x", 1.25, 1.0),
        Difference("cyan1", "holding", True, False),
        Difference("world", "possession", "cyan1", None),
        Difference("world", "touches", [], ["cyan1"]),
    ]
    assert [one.by for one in found] == [0.25, None, None, None]
    assert differences({**ours, "clock": 9.0}, ours) == []
