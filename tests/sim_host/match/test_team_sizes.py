"""The size of a side: what the rule book allows, when a match begins and while it runs."""

import pytest

from schemas.config.match_config import load_match
from schemas.config.scene import Scene, SceneRobot
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.side import Side
from sim_host.match.simulation import Simulation


@pytest.fixture
def play():
    made = []

    def make(**values):
        given = {key.replace("__", "."): value for key, value in values.items()}
        made.append(Simulation(load_match(None, {"noise.preset": "perfect"} | given)))
        return made[-1]

    yield make
    for simulation in made:
        simulation.close()


def robots_of(side, numbers, y):
    sign = 1 if side is Side.CYAN else -1
    return [SceneRobot(name=f"{side}{number}", side=side, x=-sign * 0.8 * number, y=sign * y) for number in numbers]


def ask(simulation, operation, **content):
    return simulation.handle_scene(SceneRequest(operation=SceneOperation(operation), **content))


@pytest.mark.parametrize("rules", ["msl", "paper", "china-sim-2020"])
def test_a_match_with_more_robots_than_its_rules_allow_is_refused_with_the_rules_that_allow_them(play, rules):
    with pytest.raises(TouchlineError) as refusal:
        play(rules=rules, teams__cyan__size=6)
    assert (
        str(refusal.value)
        == f"cyan has 6 robots; the rules {rules} allow 5 of a side; 6 are allowed by eleven, friendly"
    )


def test_a_scene_counts_robots_that_no_agent_moves(play):
    robots = [robot.model_copy(update={"agent": False}) for robot in robots_of(Side.MAGENTA, range(1, 7), 3.0)]
    scene = Scene(description="six that stand still", robots=robots)
    with pytest.raises(TouchlineError, match="magenta has 6 robots; the rules msl allow 5"):
        play(rules="msl", scene=scene.model_dump(mode="json"))
    assert len(play(rules="eleven", scene=scene.model_dump(mode="json")).roster.names) == 6


def test_robots_are_added_to_a_running_match_up_to_the_number_of_its_rules(play):
    simulation = play(rules="msl", teams__cyan__size=3)
    added = robots_of(Side.CYAN, range(4, 7), 6.0)
    refused = ask(simulation, "add", robots=added)
    assert refused.reason == "cyan has 6 robots; the rules msl allow 5 of a side; 6 are allowed by eleven, friendly"
    assert ask(simulation, "add", robots=added[:2]).accepted
    simulation.step({})
    assert len(simulation.roster.names) == 10
    scene = Scene(description="too many", robots=robots_of(Side.CYAN, range(1, 8), 2.0))
    assert not ask(simulation, "load", scene=scene).accepted


def test_a_running_match_grows_from_one_a_side_to_eleven_and_shrinks_again(play):
    simulation = play(rules="eleven", teams__cyan__size=1, teams__magenta__size=1)
    for side, y in ((Side.CYAN, 6.0), (Side.MAGENTA, 6.0)):
        reply = ask(simulation, "add", robots=robots_of(side, range(2, 12), y))
        assert reply.accepted, reply.reason
    tick = simulation.step({})
    names = [f"{side}{number}" for side in Side for number in range(1, 12)]
    assert list(simulation.roster.names) == names
    assert list(tick.sights) == names
    commands = {name: Command(answers_tick=tick.tick, drive=Drive(vx=1.0)) for name in names}
    assert set(simulation.step(commands).applied["inputs"]) == set(names)
    twelfth = ask(simulation, "add", robots=robots_of(Side.CYAN, [12], 6.0))
    assert twelfth.reason == "cyan has 12 robots; a side has at most 11"
    assert ask(simulation, "remove", remove=[f"{side}{number}" for side in Side for number in range(2, 12)]).accepted
    assert list(simulation.step({}).sights) == ["cyan1", "magenta1"]
