"""Policies in files, and the brain that plays them: exactly what the environment did."""

import io
import math
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from robot_agent.loading.brain_loader import load_brain
from robot_agent.sdk.contract import Briefing
from schemas.errors import TouchlineError
from schemas.messages.radio import Motion
from touchline.play.play_match import InProcessMatch
from touchline.policy.network import Network
from touchline.policy.observation import Observation
from touchline.policy.policy import load_policy
from touchline.policy.policy_brain import PolicyBrain


def network_for(match: InProcessMatch, robot: str, actions: int, hidden: int = 8) -> Network:
    sizes = (len(Observation(Briefing.of(robot, match.simulation.setup())).names), hidden, actions)
    return Network.of(np.random.default_rng(7).normal(size=Network.size(sizes)), sizes)


def test_a_network_is_the_same_after_it_was_saved(tmp_path: Path) -> None:
    network = Network.of(np.arange(Network.size((3, 4, 2))) / 20, (3, 4, 2))
    assert (network.observations, network.actions) == (3, 2)
    network.save(tmp_path / "small.npz")
    seen = np.array([0.5, -1.0, 0.25], np.float32)
    assert load_policy(tmp_path / "small.npz").action(seen).tolist() == network.action(seen).tolist()
    network.save(tmp_path / "other")
    assert (tmp_path / "other.npz").read_bytes() == (tmp_path / "small.npz").read_bytes()


def test_a_network_is_what_its_parameters_say() -> None:
    network = Network.of(np.array([2.0, 0.0, 0.0, 1.0, 0.5, 0.0]), (2, 2))
    action = network.action(np.array([0.1, 0.2], np.float32))
    assert action.tolist() == pytest.approx([np.tanh(0.7), np.tanh(0.2)])
    with pytest.raises(TouchlineError, match="has 6 parameters, in one row"):
        Network.of(np.zeros(5), (2, 2))


def saved(array: NDArray[np.floating]) -> bytes:
    """The bytes of a file `.npy`."""
    file = io.BytesIO()
    np.save(file, array.astype(np.float32))
    return file.getvalue()


def zipped(files: dict[str, bytes]) -> bytes:
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w") as written:
        for name, content in files.items():
            written.writestr(name, content)
    return archive.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("none.npz", None, "there is no policy"),
        ("text.npz", b"weights", "is no saved network"),
        ("empty.npz", b"", "is no saved network"),
        ("array.npz", saved(np.zeros(3)), "is no saved network"),
        ("bytes.npz", zipped({"weights0.npy": b"0", "offsets0.npy": b"0"}), "is no saved network"),
        (
            "nan.npz",
            zipped({"weights0.npy": saved(np.full((1, 2), np.nan)), "offsets0.npy": saved(np.zeros(1))}),
            "finite",
        ),
        ("brain.py", b"", "its name ends in .npz or .zip"),
        ("text.zip", b"weights", "stable-baselines3|no model of Stable-Baselines3"),
    ],
)
def test_a_file_without_a_policy_is_one_clear_error(tmp_path: Path, name: str, content: bytes, said: str) -> None:
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(TouchlineError, match=said):
        load_policy(tmp_path / name)


def test_layers_that_do_not_fit_are_one_clear_error(tmp_path: Path) -> None:
    layers = [
        np.zeros((4, 3), np.float32),
        np.zeros(4, np.float32),
        np.zeros((2, 5), np.float32),
        np.zeros(2, np.float32),
    ]
    names = ("weights0", "offsets0", "weights1", "offsets1")
    np.savez(tmp_path / "torn.npz", allow_pickle=False, **dict(zip(names, layers, strict=True)))
    with pytest.raises(TouchlineError, match="its layers do not fit"):
        load_policy(tmp_path / "torn.npz")


@pytest.mark.parametrize("space", ["observation", "action"])
def test_a_model_of_other_than_vectors_is_one_clear_error(tmp_path: Path, space: str) -> None:
    models, gymnasium = pytest.importorskip("stable_baselines3"), pytest.importorskip("gymnasium")
    spaces = dict.fromkeys(("observation", "action"), gymnasium.spaces.Box(-1.0, 1.0, (2,)))
    env = type("Env", (gymnasium.Env,), {f"{name}_space": one for name, one in spaces.items()})
    setattr(env, f"{space}_space", gymnasium.spaces.Discrete(3))
    models.PPO("MlpPolicy", env(), n_steps=2, batch_size=2, device="cpu").save(tmp_path / "other.zip")
    with pytest.raises(TouchlineError, match="is no model of Stable-Baselines3 of vectors"):
        load_policy(tmp_path / "other.zip")


@pytest.mark.parametrize("use_sde", [False, True])
def test_a_model_acts_as_it_did_before_it_was_saved(tmp_path: Path, use_sde: bool) -> None:
    models, gymnasium = pytest.importorskip("stable_baselines3"), pytest.importorskip("gymnasium")
    spaces = {f"{name}_space": gymnasium.spaces.Box(-1.0, 1.0, (2,)) for name in ("observation", "action")}
    env = type("Env", (gymnasium.Env,), spaces)()
    model = models.PPO("MlpPolicy", env, n_steps=2, batch_size=2, use_sde=use_sde, seed=1, device="cpu")
    model.save(tmp_path / "model.zip")
    seen = np.array([0.5, -1.0], np.float32)
    action, _ = model.predict(seen, deterministic=True)
    assert action.any() and load_policy(tmp_path / "model.zip").action(seen).tolist() == action.tolist()


def test_after_a_missed_sight_the_next_one_is_decided_on_and_told(rovers: InProcessMatch) -> None:
    sight = rovers.simulation.now.sights.perceived["one"]
    brain = PolicyBrain(Briefing.of("one", rovers.simulation.setup()), network_for(rovers, "one", 2))
    answers = [
        brain.act(sight.replace(tick=tick, self=Motion(x=tick / 10, y=0.0, heading=0.0))) for tick in (0, 1, 6, 7)
    ]
    assert [answer.radio is not None for answer in answers] == [True, False, True, False]
    assert answers[0].drive == answers[1].drive != answers[2].drive == answers[3].drive


def test_an_action_that_is_not_finite_moves_no_robot(rovers: InProcessMatch) -> None:
    briefing = Briefing.of("one", rovers.simulation.setup())
    sizes = len(Observation(briefing).names), 2
    brain = PolicyBrain(briefing, Network.of(np.full(Network.size(sizes), math.nan), sizes))
    with pytest.raises(ValueError, match=r"the policy's action is \[nan, nan\]"):
        brain.act(rovers.simulation.now.sights.perceived["one"])


def test_a_policy_for_another_robot_is_one_clear_error(rovers: InProcessMatch, tmp_path: Path) -> None:
    network_for(rovers, "one", 5).save(tmp_path / "five.npz")
    briefing = Briefing.of("one", rovers.simulation.setup())
    with pytest.raises(TouchlineError, match=r"is for actions of 5 numbers; one has 2 in this match"):
        load_brain("policy:five.npz", briefing, tmp_path)
    with pytest.raises(TouchlineError, match=r"there is no module nobody"):
        network_for(rovers, "one", 2).save(tmp_path / "two.npz")
        load_brain("policy:two.npz", replace(briefing, parameters={"corrects": "nobody:Brain"}), tmp_path)
    with pytest.raises(TouchlineError, match=r"there is no file six.npz beside the match file"):
        load_brain("policy:six.npz", briefing, tmp_path)
