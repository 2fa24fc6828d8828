"""A whole match without a network: sights, radio, referee and world joined, the same for equal seeds."""

from collections.abc import Iterator
from typing import Any

import pytest
from pytest import approx

from schemas.config.match_config import load_match
from schemas.config.roster import Placement
from schemas.errors import TouchlineError
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.radio import Belief, Motion, Radio
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.messages.sight import ReceivedRadio, Sight
from schemas.messages.world import World
from schemas.side import Side
from schemas.soccer.game import EventKind, TeamPhase
from schemas.wire.message import VERSION
from schemas.wire.part import encode
from schemas.wire.part_faults import validated
from sim_host.match.simulation import Simulation, TickResult


def simulate(**overrides: Any) -> Simulation:
    names = {key.replace("__", "."): value for key, value in overrides.items()}
    return Simulation(load_match(None, {"duration": 8.0, "noise.preset": "perfect"} | names))


@pytest.fixture
def simulation() -> Iterator[Simulation]:
    simulation = simulate()
    yield simulation
    simulation.close()


@pytest.mark.parametrize(
    ("place", "who"), [([-5.0, 2.3], "cyan4"), ([0.3, 0.0], "the ball"), ([10.6, 0.4], "magenta1")]
)
def test_an_obstacle_of_the_match_file_where_somebody_starts_is_refused(place: list[float], who: str) -> None:
    pole = {"name": "pole", "shape": "cylinder", "place": place, "radius": 0.3, "height": 1.0}
    with pytest.raises(TouchlineError, match=rf"{who} at .* would be 0\.\d+ m inside pole; choose another place"):
        simulate(obstacles=[pole])


def command(simulation: Simulation, **said: Any) -> Command:
    return Command(answers_tick=simulation.now.tick, **said)


def sight(tick: TickResult, robot: str) -> Sight:
    return Sight.decode(tick.sights[robot])


def test_the_world_has_the_robots_that_touched_the_ball_and_the_one_that_kicked(simulation: Simulation) -> None:
    placements = [Placement(body="ball", x=-4.6, y=3.0), Placement(body="cyan2", x=-5.0, y=3.0)]
    while not simulation.state.running:  # until START the referee puts the ball back to its spot
        simulation.step({})
    assert simulation.handle_scene(SceneRequest(operation=SceneOperation.PLACE, place=placements)).accepted
    worlds = []
    for number in range(40):
        kick = Kick(mode=KickMode.GROUND, speed=6.0) if number == 30 else None
        said = {"cyan2": command(simulation, drive=Drive(vx=0.3), dribble=True, kick=kick)}
        worlds.append(validated(World, simulation.step(said).world))
    assert worlds[0].touches == [] and worlds[0].kicked is None
    assert worlds[29].possession == "cyan2" and worlds[29].touches == ["cyan2"]
    assert [number for number, world in enumerate(worlds) if world.kicked == "cyan2"] == [30]
    assert worlds[30].touches == ["cyan2"] and worlds[39].touches == []


def test_robots_begin_in_their_own_half_facing_the_goal_they_attack(simulation: Simulation) -> None:
    for name in simulation.roster.names:
        own = sight(simulation.now, name).self
        assert own.x < 0 and own.heading == approx(0, abs=1e-4)


def test_a_sight_holds_what_the_robot_needs_and_nothing_of_the_others_names(simulation: Simulation) -> None:
    seen = sight(simulation.now, "cyan2")
    assert (seen.robot, seen.side, seen.tick, seen.holding) == ("cyan2", Side.CYAN, 0, False)
    assert seen.ball is not None and (seen.ball.x, seen.ball.y) == (0, 0)
    assert len(seen.obstacles) == 9
    assert seen.game.phase is TeamPhase.PRE_GAME


def test_a_word_on_the_radio_reaches_teammates_and_the_coach(simulation: Simulation) -> None:
    tick = simulation.step({"cyan2": command(simulation, radio=Radio(role="striker", intention="shoot"))})
    assert [(side, belief.robot) for side, belief in tick.beliefs] == [(Side.CYAN, "cyan2")]
    for _ in range(5):
        tick = simulation.step({})
    assert sight(tick, "cyan3").radio["cyan2"].role == "striker"
    assert 0.1 < sight(tick, "cyan3").radio["cyan2"].age < 0.12, "it left within the tick of the command"
    assert sight(tick, "magenta1").radio == {}


def test_a_radio_message_is_delivered_and_published_unchanged() -> None:
    word = Radio(self=Motion(x=1.5, y=-0.0, heading=3e16, vx=0.0), intention="shoot", extra={"speed": 1e17, "n": 2})
    one = simulate(radio__delay=0.0, radio__jitter=0.0, radio__loss=0.0)
    tick = one.step({"cyan2": Command.decode(Command(answers_tick=0, radio=word).encode())})
    one.close()
    [(_, belief)] = tick.beliefs
    assert Belief.decode(belief.encode()) == Belief(tick=1, time=tick.time, robot="cyan2", radio=word)
    heard = sight(tick, "cyan3").radio
    assert heard == {"cyan2": ReceivedRadio.of(word, heard["cyan2"].age)}


def test_a_refused_kick_comes_back_in_the_outcome(simulation: Simulation) -> None:
    said = command(simulation, kick=Kick(mode=KickMode.GROUND, speed=3))
    tick = simulation.step({"cyan4": said})
    outcome = sight(tick, "cyan4").outcome
    assert (outcome.answers_tick, outcome.refused) == (0, ["kick: ball not held"])
    assert tick.refused == {"cyan4": 1}
    assert sight(simulation.step({}), "cyan4").outcome.refused == []


def test_the_coachs_order_stands_in_the_sights_of_its_side_alone(simulation: Simulation) -> None:
    simulation.orders[Side.MAGENTA] = CoachOrder(sequence=2, tactic="press")
    tick = simulation.step({})
    order = sight(tick, "magenta3").order
    assert order is not None and (order.sequence, order.tactic) == (2, "press")
    assert sight(tick, "cyan3").order is None


def test_after_half_time_cyan_attacks_the_other_way_and_still_believes_it_is_plus_x(simulation: Simulation) -> None:
    while simulation.state.half == 1:
        simulation.step({})
    tick = simulation.step({})
    assert simulation.state.cyan_attacks == -1
    assert sight(tick, "cyan1").self.x < 0 < tick.world["robots"]["cyan1"]["x"]


def test_the_order_in_which_answers_arrive_changes_nothing() -> None:
    sights = []
    for backwards in (False, True):
        one = simulate(radio__budget=3000.0)
        for _ in range(10):
            said = {name: command(one, radio=Radio(role=name)) for name in one.roster.names}
            one.step(dict(reversed(said.items())) if backwards else said)
        sights.append(one.now.sights)
        one.close()
    assert sights[0] == sights[1]


def test_without_a_hash_chain_a_match_is_the_same_and_its_inputs_are_not_reported() -> None:
    config = load_match(None, {"duration": 8.0})
    chained, plain = Simulation(config), Simulation(config, chained=False)
    for _ in range(60):
        said = {name: command(chained, drive=Drive(vx=1.0), dribble=True) for name in chained.roster.names}
        one, other = chained.step(said), plain.step(said)
    assert one.world == other.world and dict(one.sights) == dict(other.sights)
    assert one.applied["chain"] and not other.applied and not other.applied_encoded
    chained.close()
    plain.close()


def test_the_world_of_a_tick_stays_what_it_was_when_it_is_read_later(simulation: Simulation) -> None:
    before = simulation.now
    simulation.step({"cyan2": command(simulation, drive=Drive(vx=1.0))})
    at_once = simulation.now.world
    simulation.step({"cyan2": command(simulation, drive=Drive(vx=1.0))})
    assert (before.world["tick"], at_once["tick"], simulation.now.world["tick"]) == (0, 1, 2)
    assert before.world["robots"]["cyan2"]["vx"] == 0.0 < at_once["robots"]["cyan2"]["vx"]


def test_a_checkpoint_is_made_at_every_kick_off_and_recorded() -> None:
    one = simulate()
    marks, starts = [], []
    while not one.over:
        tick = one.step({})
        marks += [tick.tick] if tick.applied["checkpoint"] else []
        starts += [e.tick for e in tick.events if e.kind is EventKind.START and "kick-off" in e.text]
    assert starts and marks == [tick + 1 for tick in starts]
    one.close()


def test_what_was_placed_is_recorded_as_an_input_of_its_tick(simulation: Simulation) -> None:
    assert {p.body for p in simulation.now.applied["placements"]} == {*simulation.roster.names, "ball"}
    tick = simulation.step({})
    while not tick.applied["placements"]:
        tick = simulation.step({})
    assert [p.body for p in tick.applied["placements"]] == ["ball"]


def test_the_setup_tells_everything_a_robot_must_know(simulation: Simulation) -> None:
    setup = simulation.setup()
    again = type(setup).decode(setup.encode())
    assert again.pitch == simulation.profile.field and again.drive == simulation.profile.drive
    assert again.teams[Side.CYAN].robots == ["cyan1", "cyan2", "cyan3", "cyan4", "cyan5"]
    assert set(again.engine) == {"engine", "libm", "numpy", "referee"}


def test_a_match_with_types_and_obstacles_is_set_up_and_played_as_in_its_file() -> None:
    one = simulate(
        teams__cyan__types={"cyan1": "keeper", "cyan3": "slow"},
        obstacles=[{"name": "crate", "shape": "box", "place": [3.0, 5.0], "heading": 0.5, "size": [0.4, 0.8, 0.6]}],
    )
    assert [model.type for model in one.roster.models[:4]] == ["keeper", "standard", "slow", "standard"]
    tick = one.step({"cyan3": command(one, drive=Drive(vx=9))})
    said = World.decode(encode({"version": VERSION, **tick.world})).obstacles["crate"]
    assert (said.x, said.y, said.heading, said.size_x, said.size_y, said.height) == (3.0, 5.0, 0.5, 0.4, 0.8, 0.6)
    assert one.setup().for_robot("cyan3").drive.max_speed == 2.0
    one.close()
