"""A task in a match of soccer: it is scored, rewarded and ended while the referee officiates."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pytest import approx

from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import ActionName, EventKind, Phase
from sim_host.games import game_of_match
from sim_host.match.live_parameters import LiveParameters
from sim_host.match.opening import opening_layout
from sim_host.match.simulation import Simulation
from sim_host.staging.variation import varied
from support.task_match import SCENE, task_match


@pytest.fixture
def play(tmp_path: Path) -> Iterator[Any]:
    """Make simulations of a match."""
    made = []

    def make(**overrides: Any) -> Simulation:
        made.append(Simulation(task_match(tmp_path, **overrides)))
        return made[-1]

    yield make
    for one in made:
        one.close()


def test_the_score_is_published_with_the_goals_and_the_change_of_it_is_the_reward(play) -> None:
    simulation = play()
    simulation.step({})
    first = simulation.state.game_state(1, 0.02)
    assert first.phase is Phase.PLAY and first.score.cyan == 0
    assert first.value == approx(simulation.now.world["ball"]["x"]) and first.left == approx(7.98)
    simulation.step({})
    assert simulation.state.reward == approx(simulation.state.value - first.value)


def test_a_task_ends_by_its_time_in_the_middle_of_a_half(play) -> None:
    simulation = play(duration=0.5, **{"task.score": "tally:phases"})
    events = []
    while not simulation.over:
        events += simulation.step({}).events
    assert (simulation.state.ended_by, simulation.now.tick, simulation.state.value) == ("time", 25, 11.0)
    assert [event.text for event in events] == ["ends after 0.50 s with the score 11"]
    sight = Sight.decode(simulation.now.sights["cyan1"])
    assert (sight.game.phase, sight.game.running) == ("full_time", False)
    assert simulation.step({}, [RefereeAction(action=ActionName.STOP)]).replies[0].reason == "the match is over"


def test_a_task_ends_by_its_score_and_with_the_game(play) -> None:
    rolling = play(scene=SCENE | {"ball": {"x": 1.0, "y": 0.0, "vy": 9.0}, "vary": []})
    while not rolling.over:
        tick = rolling.step({})
    assert rolling.state.ended_by == "score" and rolling.now.time < 8.0
    assert EventKind.BALL_OUT in [event.kind for event in tick.events]
    ended = play()
    reply = ended.step({}, [RefereeAction(action=ActionName.END_GAME)]).replies[0]
    assert (reply.accepted, ended.state.ended_by) == (True, "game")


def test_a_kick_earns_the_reward_that_the_function_gives(play) -> None:
    simulation = play(scene=SCENE | {"ball": {"x": 0.4, "y": 0.0}, "vary": []})
    rewards, kick = [], Kick(mode=KickMode.GROUND, speed=3.0)
    for _ in range(60):
        command = Command(answers_tick=simulation.now.tick, drive=Drive(vx=0.5), dribble=True, kick=kick)
        simulation.step({"cyan1": command})
        rewards.append(simulation.state.reward)
    assert 2.0 in rewards


def test_each_seed_draws_a_start_and_equal_seeds_draw_equal_ones(play) -> None:
    one, again, other = (play(seed=seed).now.world for seed in (3, 3, 4))
    assert one["ball"] == again["ball"] != other["ball"]
    assert one["obstacles"]["post"]["x"] == again["obstacles"]["post"]["x"] != other["obstacles"]["post"]["x"]
    assert abs(one["ball"]["y"]) <= 3.0 and one["ball"]["x"] == 1.0


def test_a_start_whose_bodies_overlap_is_drawn_again(tmp_path: Path) -> None:
    crowded = SCENE | {"vary": [{"body": "magenta1", "x": 6.0, "y": 4.0}, {"body": "ball", "x": 1.2}]}
    redrawn = []
    for seed in range(20):
        config = task_match(tmp_path, scene=crowded, seed=seed)
        numbers = LiveParameters.of(config)
        start, _ = opening_layout(config, numbers, game_of_match(config))
        assert config.scene is not None
        if start != varied(config.scene, seed):
            redrawn.append(seed)
        robot, places = numbers.types["standard"].body.radius, [(one.x, one.y) for one in start.robots]
        assert math.dist(*places) > 2 * robot
        gaps = [math.dist(place, (start.ball.x, start.ball.y)) for place in places]
        assert min(gaps) > robot + numbers.profile.ball.radius
    assert redrawn == [1, 10, 11, 17]


def test_a_scene_without_room_is_refused(play) -> None:
    full = SCENE | {"obstacles": [SCENE["obstacles"][0] | {"place": [0.0, 0.0]}], "vary": [{"body": "post", "x": 0.01}]}
    with pytest.raises(TouchlineError, match=r"none of 100 starts fits: .*post"):
        play(scene=full)


def test_no_start_is_drawn_for_more_robots_than_the_game_allows(play, monkeypatch: pytest.MonkeyPatch) -> None:
    robots = [{"name": f"cyan{number}", "side": "cyan", "x": -number, "y": 2.0} for number in range(1, 9)]
    monkeypatch.setattr("sim_host.match.opening.varied", lambda *_: pytest.fail("a start was drawn"))
    with pytest.raises(TouchlineError, match=r"cyan .*8"):
        play(rules="msl", scene=SCENE | {"robots": robots, "vary": [{"body": "ball", "y": 3.0}]})
