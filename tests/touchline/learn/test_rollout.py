"""A policy does in a match what it did in the environment: the same commands at every tick, and the same states."""

from pathlib import Path

import numpy as np
import pytest

import touchline.tasks
from recordings.reading.recording import open_recording
from schemas.config.match_config import load_match
from schemas.messages.command import Command
from touchline.learn import TaskEnv
from touchline.play.play_match import InProcessMatch
from touchline.policy.network import Network

FILE = Path(touchline.tasks.__path__[0]) / "keepaway_3v2.toml"
CORRECTS = {"corrects": "touchline.tasks.keepaway_3v2:Keeper"}
SHORT = {"duration": 2.0, "seed": 11}


@pytest.mark.parametrize("parameters", [{}, CORRECTS])
def test_a_match_gives_a_policy_the_commands_of_the_environment(tmp_path: Path, parameters: dict[str, str]) -> None:
    """The commands of both are equal at every tick, and so are the chains over all states."""
    env = TaskEnv("keepaway_3v2", overrides={"duration": 2.0}, parameters=parameters)
    size = len(env.observation_entries("cyan1")), 16, len(env.action_entries("cyan1"))
    network = Network.of(np.random.default_rng(1).normal(size=Network.size(size)), size)
    network.save(tmp_path / "keeper.npz")
    observations, _ = env.reset(11, {"record": tmp_path / "env.mcap"})
    while env.agents:
        observations, *_ = env.step({agent: network.action(seen) for agent, seen in observations.items()})

    team = {"brain": f"policy:{tmp_path / 'keeper.npz'}", "parameters": parameters}
    played, chains = played_by({f"teams.cyan.{key}": value for key, value in team.items()})
    recorded = commands_of(tmp_path / "env.mcap")
    assert [recorded[tick] for tick in range(len(played))] == played
    assert len({command.drive for each in played for command in each.values()}) > 20
    assert chains == chains_of(tmp_path / "env.mcap")[1:]


def test_a_correction_of_zeros_leaves_the_commands_of_the_brain_as_they_are(tmp_path: Path) -> None:
    env = TaskEnv("keepaway_3v2", overrides={"duration": 2.0}, parameters=CORRECTS)
    env.reset(11, {"record": tmp_path / "env.mcap"})
    while env.agents:
        env.step({agent: np.zeros(env.action_space(agent).shape, np.float32) for agent in env.agents})
    played, chains = played_by({})
    recorded = commands_of(tmp_path / "env.mcap")
    assert [recorded[tick] for tick in range(len(played))] == played
    assert any(command.radio and command.radio.intention for each in played for command in each.values())
    assert chains == chains_of(tmp_path / "env.mcap")[1:]


def played_by(overrides: dict[str, object]) -> tuple[list[dict[str, Command]], list[str]]:
    """The commands of cyan at each tick of the match, and the chain after it."""
    match = InProcessMatch(load_match(FILE, {**SHORT, **overrides}), brain_folder=FILE.parent)
    played: list[dict[str, Command]] = []
    chains = []
    while not match.simulation.over:
        chains.append(match.step().applied["chain"])
        played.append({name: command for name, command in match.commands.items() if name.startswith("cyan")})
    match.close()
    return played, chains


def commands_of(recording: Path) -> dict[int, dict[str, Command]]:
    """Tick → the commands of cyan that answer it."""
    found: dict[int, dict[str, Command]] = {}
    for robot in ("cyan1", "cyan2", "cyan3"):
        for _, command in open_recording(recording).decoded(f"robot/{robot}/command"):
            found.setdefault(command.answers_tick, {})[robot] = command
    return found


def chains_of(recording: Path) -> list[str]:
    return [applied.chain for _, applied in open_recording(recording).decoded("host/applied")]
