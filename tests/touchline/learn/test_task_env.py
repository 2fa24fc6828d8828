"""The environment of a team: PettingZoo's own tests, what a step is, and one clear error for each wrong call."""

import copy
import pickle
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pettingzoo
import pytest
from matplotlib import pyplot
from pettingzoo.test import max_cycles_test, parallel_api_test, parallel_seed_test
from pettingzoo.utils import parallel_to_aec

from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive
from schemas.messages.sight import Sight
from support import display
from support.imports import forgotten_imports
from support.rover_task import write_rover_task
from touchline.learn import TaskEnv, scores
from touchline.learn.registry import environment_name
from touchline.matches.task.task import shipped_tasks

KEEPAWAY = "keepaway_3v2"


def keepaway(**settings: Any) -> TaskEnv:
    env: TaskEnv = pettingzoo.make("parallel", environment_name(KEEPAWAY), **settings)
    return env


def still(env: TaskEnv) -> dict[str, Any]:
    return {agent: np.zeros(env.action_space(agent).shape, np.float32) for agent in env.agents}


@pytest.fixture
def windows() -> Iterator[None]:
    """Matplotlib opens windows that nobody sees."""
    with display.backend("module://support.display"):
        yield


@pytest.fixture
def rovers(tmp_path: Path) -> Iterator[Callable[..., TaskEnv]]:
    path, made = write_rover_task(tmp_path), []

    def make(**settings: Any) -> TaskEnv:
        made.append(TaskEnv(Path(path), **settings))
        return made[-1]

    with forgotten_imports(tmp_path):
        yield make
        for env in made:
            env.close()


def test_pettingzoo_finds_its_api_kept(rovers: Callable[..., TaskEnv]) -> None:
    parallel_api_test(rovers(), 20)
    parallel_api_test(keepaway(), 20)


def test_pettingzoo_finds_equal_seeds_equal() -> None:
    parallel_seed_test(keepaway, 20)


def test_an_episode_is_truncated_after_the_most_steps_that_are_asked_for(rovers: Callable[..., TaskEnv]) -> None:
    max_cycles_test(
        SimpleNamespace(
            parallel_env=lambda max_cycles: rovers(max_cycles=max_cycles),
            env=lambda max_cycles: parallel_to_aec(rovers(max_cycles=max_cycles)),
        )
    )


def test_every_task_that_ships_has_an_environment() -> None:
    for task in shipped_tasks():
        env = pettingzoo.make("parallel", environment_name(task))
        observations, _ = env.reset(1)
        assert all(env.observation_space(agent).contains(seen) for agent, seen in observations.items())
        env.close()


def test_names_of_environments_are_those_of_tasks_in_words() -> None:
    assert environment_name("keepaway_3v2") == "Touchline/Keepaway3v2-v0"
    assert environment_name("pass_and_shoot") == "Touchline/PassAndShoot-v0"


def test_a_step_lasts_the_ticks_of_a_decision_and_its_reward_is_the_change_of_the_score(
    rovers: Callable[..., TaskEnv],
) -> None:
    env = rovers(parameters={"decision_ticks": 7})
    env.reset(3)
    ahead = still(env) | {"one": np.array([1.0, 0.0], np.float32)}
    _, first, *_, infos = env.step(ahead)
    assert infos["one"]["tick"] == 7
    assert first["one"] == first["two"] == pytest.approx(infos["two"]["score"])
    _, second, *_, infos = env.step(ahead)
    assert first["one"] + second["one"] == pytest.approx(infos["one"]["score"])
    assert second["one"] > first["one"] > 0


def test_score_terminates_and_time_truncates(rovers: Callable[..., TaskEnv]) -> None:
    env = rovers()
    ends = []
    for speed in (1.0, 0.0):
        env.reset(3)
        while env.agents:
            *_, terminated, truncated, _ = env.step(still(env) | {"one": np.array([speed, 0.0])})
        ends.append((terminated["two"], truncated["two"], env.ended_by))
    assert ends == [(True, False, "score"), (False, True, "time")]


def test_infos_are_numbers_with_equal_names_in_all_steps_as_torchrl_requires(rovers: Callable[..., TaskEnv]) -> None:
    env = rovers()
    _, infos = env.reset(3)
    kinds = {name: type(value) for name, value in infos["one"].items()}
    while env.agents:
        *_, infos = env.step(still(env))
        assert all({name: type(value) for name, value in infos[agent].items()} == kinds for agent in infos)
    assert set(kinds.values()) <= {int, float}


def test_equal_seeds_are_equal_episodes_and_others_are_drawn(rovers: Callable[..., TaskEnv]) -> None:
    env = rovers()
    seeds, starts = [], []
    for seed in (5, None, 5, None):
        observations, infos = env.reset(seed)
        seeds.append(infos["two"]["seed"])
        starts.append(observations["two"].tolist())
    assert seeds[0] == seeds[2] == 5 and seeds[1] == seeds[3] != 5
    assert starts[0] == starts[2] != starts[1] == starts[3]


def test_robots_that_are_no_agents_are_played_by_their_brain() -> None:
    env = keepaway(robots=["cyan2"], observation="sight", overrides={"noise.preset": "perfect"})
    before, _ = env.reset(2)
    assert env.possible_agents == list(before) == ["cyan2"]
    for _ in range(5):
        after, *_ = env.step(still(env))
    bodies = zip(before["cyan2"].obstacles, after["cyan2"].obstacles, strict=True)
    moved = [abs(one.x - other.x) for one, other in bodies]
    assert sum(distance > 0.05 for distance in moved) >= 2


def test_plain_sights_are_observed_where_they_are_asked_for(rovers: Callable[..., TaskEnv]) -> None:
    env = rovers(observation="sight")
    observations, _ = env.reset(1)
    assert isinstance(observations["one"], Sight) and env.observation_space("one").contains(observations["one"])
    assert env.observation_space("one") == env.observation_space("two")
    with pytest.raises(TouchlineError, match="not sampled"):
        env.observation_space("one").sample()


def test_a_brain_whose_advice_is_followed_plays_as_in_a_match() -> None:
    env = TaskEnv("coverage", advice=True, parameters={"decision_ticks": 1}, overrides={"duration": 4.0})
    _, infos = env.reset(3)
    while env.agents:
        *_, infos = env.step({agent: infos[agent]["advice"] for agent in env.agents})
    (score,) = scores("coverage", [3], overrides={"duration": 4.0})
    assert 0.01 < score == pytest.approx(infos["rover1"]["score"])


def test_a_brain_that_advises_sees_every_sight_once(
    rovers: Callable[..., TaskEnv], monkeypatch: pytest.MonkeyPatch
) -> None:
    env, seen = rovers(advice=True, parameters={"decision_ticks": 3}), []

    def act(_brain: object, sight: Sight) -> Command:
        seen.append((sight.robot, sight.tick))
        return Command(answers_tick=sight.tick, drive=Drive(omega=-20.0))

    monkeypatch.setattr(sys.modules["rover_tally"].Still, "act", act)
    env.reset(1)
    *_, infos = env.step(still(env))
    assert sorted(seen) == [(robot, tick) for robot in ("one", "two") for tick in range(4)]
    assert infos["two"]["advice"].tolist() == [0.0, -1.0] and env.action_space("two").contains(infos["two"]["advice"])
    _, infos = rovers().reset(1)
    assert "advice" not in infos["one"] and len(seen) == 8


def test_the_state_is_what_all_agents_observe(rovers: Callable[..., TaskEnv]) -> None:
    env = rovers()
    observations, _ = env.reset(1)
    assert env.state().tolist() == [*observations["one"].tolist(), *observations["two"].tolist()]


def test_a_picture_shows_where_the_robots_are(rovers: Callable[..., TaskEnv]) -> None:
    env = rovers(render_mode="rgb_array")
    env.reset(1)
    before = env.render()
    while env.agents:
        env.step(still(env) | {"one": np.array([1.0, 0.0], np.float32)})
    env.reset(1)
    assert before.dtype == np.uint8 and before.ndim == 3 and np.array_equal(before, env.render())
    env.step(still(env) | {"one": np.array([0.0, 1.0], np.float32)})
    assert not np.array_equal(before, env.render())
    assert rovers().render() is None
    with pytest.raises(TouchlineError, match='did you mean "rgb_array"'):
        rovers(render_mode="rgb_aray")


@pytest.mark.usefixtures("windows")
def test_a_window_shows_each_step_until_its_environment_is_closed(rovers: Callable[..., TaskEnv]) -> None:
    env = rovers(render_mode="human")
    env.reset(1)
    env.step(still(env) | {"one": np.array([0.0, 1.0], np.float32)})
    assert display.shown == ["rovers"] and len(set(display.drawn)) == 2 and env.render() is None
    env.reset(1)
    assert len(display.shown) == 1 and display.drawn[-1] == display.drawn[0]
    assert len(pyplot.get_fignums()) == 1
    env.close()
    assert pyplot.get_fignums() == []


@pytest.mark.usefixtures("windows")
def test_an_episode_goes_on_when_somebody_closes_its_window(rovers: Callable[..., TaskEnv]) -> None:
    env = rovers(render_mode="human")
    env.reset(1)
    pyplot.close("all")
    env.step(still(env))
    env.reset(2)
    assert len(display.drawn) == 1


def test_where_no_window_opens_an_environment_says_so(rovers: Callable[..., TaskEnv]) -> None:
    with display.backend("agg"):
        with pytest.raises(TouchlineError, match='opens no window here, with its backend agg; give "rgb_array"'):
            rovers(render_mode="human").reset(1)
        assert pyplot.get_fignums() == []


def test_a_recording_ends_with_the_next_reset(rovers: Callable[..., TaskEnv], tmp_path: Path) -> None:
    env = rovers()
    env.reset(9, {"record": tmp_path / "nine.mcap"})
    env.step(still(env))
    env.reset(9)
    assert (tmp_path / "nine.mcap").read_bytes().endswith(b"\x89MCAP0\r\n")


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"robots": ["ome"]}, 'ome does not do this task; did you mean "one"?'),
        ({"robots": []}, "no robot is an agent"),
        ({"robots": "one"}, 'robots is "one"; give a list of names'),
        ({"robots": [1]}, "1 does not do this task; known: one, two"),
        ({"observation": "sigth"}, 'did you mean "sight"?'),
        ({"max_cycles": 0}, "max_cycles is 0; give a whole number of steps, or leave it out"),
        ({"max_cycles": 2.5}, "max_cycles is 2.5; give a whole number"),
        ({"max_cycles": "9"}, "max_cycles is '9'; give a whole number"),
        ({"observation": 3}, 'observation is "3"; known: vector, sight'),
        ({"parameters": {"decision_tick": 3}}, 'did you mean "decision_ticks"?'),
        ({"parameters": {"decision_ticks": 0}}, "decision_ticks is 0; write a whole number from 1 to 1000"),
        ({"parameters": {"observe": "motoin"}}, 'names "motoin"; did you mean "motion"?'),
        ({"parameters": {"act": "vx omga"}}, 'names "omga"; did you mean "omega"?'),
        ({"parameters": {"corrects": "policy:one.npz"}}, "corrects is 'policy:one.npz'; write a brain of code"),
        ({"parameters": {"corrects": "rover_tally:Stil"}}, 'did you mean "Still"?'),
        ({"parameters": {"corrects": "rover_tally:Still"}, "advice": True}, "there is no advice on corrections"),
        ({"overrides": {"duratoin": 3}}, "duration"),
        ({"overrides": {"seed": 3}}, "give it to reset(seed=…)"),
    ],
)
def test_wrong_settings_are_one_clear_error(rovers: Callable[..., TaskEnv], settings: Any, said: str) -> None:
    with pytest.raises(TouchlineError) as raised:
        rovers(**settings)
    assert said in str(raised.value) and "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("actions", "said"),
    [
        ({"one": [0.0, 0.0]}, "two has no action; give one for each of one, two"),
        ({"one": [0.0, 0.0], "tow": [0.0, 0.0]}, "'tow' is no agent; did you mean \"two\"?"),
        ({"one": [0.0, 0.0], "two": [0.0]}, "the action of two has the shape (1,); it is (2,): vx, omega"),
        ({"one": [0.0, float("nan")], "two": [0.0, 0.0]}, "the action of one is [0.0, nan]; give finite numbers"),
        ({"one": "left", "two": [0.0, 0.0]}, "the action of one is 'left'; give 2 numbers"),
    ],
)
def test_wrong_actions_are_one_clear_error(rovers: Callable[..., TaskEnv], actions: Any, said: str) -> None:
    env = rovers()
    env.reset(1)
    with pytest.raises(TouchlineError) as raised:
        env.step(actions)
    assert said in str(raised.value)


def test_a_step_outside_of_an_episode_is_one_clear_error(rovers: Callable[..., TaskEnv]) -> None:
    env = rovers()
    with pytest.raises(TouchlineError, match="call reset"):
        env.step({})
    with pytest.raises(TouchlineError, match="call reset"):
        env.state()
    env.reset(1)
    actions = still(env)
    while env.agents:
        env.step(actions)
    with pytest.raises(TouchlineError, match="call reset"):
        env.step(actions)


def test_what_a_brain_beside_the_learners_raises_is_noted_with_robot_and_tick(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("broken_takers.py").write_text("def act(sight):\n    raise ValueError('no idea')\n")
    with forgotten_imports(tmp_path):
        env = keepaway(overrides={"teams.magenta.brain": "broken_takers:act"})
        env.reset(1)
        with pytest.raises(ValueError, match=r"^no idea\nmagenta1, tick 0$"):
            env.step(still(env))
        env.close()


@pytest.mark.parametrize("observation", ["vector", "sight"])
def test_a_copy_of_an_environment_begins_episodes_of_its_own(rovers: Callable[..., TaskEnv], observation: str) -> None:
    env = rovers(observation=observation)
    env.reset(3)
    for copied in (copy.copy(env), copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
        with pytest.raises(TouchlineError, match="call reset"):
            copied.step(still(env))
        observations, _ = copied.reset(4)
        copied.close()
        assert all(copied.observation_space(agent).contains(seen) for agent, seen in observations.items())
        assert env.action_space("one") == copied.action_space("one")
    *_, infos = env.step(still(env))
    assert (infos["one"]["seed"], infos["one"]["tick"]) == (3, 5)


def test_parameters_that_the_match_file_names_may_be_given() -> None:
    env = keepaway(overrides={"teams.cyan.parameters.lead": 1.0}, parameters={"lead": 2.0})
    env.reset(1)
    env.close()


def test_a_recording_without_a_path_is_one_clear_error(rovers: Callable[..., TaskEnv]) -> None:
    with pytest.raises(TouchlineError, match="record is 3; give the path of an MCAP file"):
        rovers().reset(1, {"record": 3})
    with pytest.raises(TouchlineError, match=r"options are \[1\]; give a dict"):
        rovers().reset(1, [1])


@pytest.mark.parametrize("seed", [-1, 2**63, 1.5, True, "one"])
def test_a_wrong_seed_is_one_clear_error(rovers: Callable[..., TaskEnv], seed: Any) -> None:
    with pytest.raises(TouchlineError, match="give a whole number from 0"):
        rovers().reset(seed)
