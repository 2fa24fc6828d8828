"""A task as a parallel environment of PettingZoo: an agent for each robot of the side that does the task."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from gymnasium.spaces import Box, Space
from numpy.typing import NDArray
from pettingzoo import ParallelEnv

from schemas.config.match_parts import Parameter
from schemas.errors import TouchlineError, did_you_mean
from schemas.messages.command import Command
from schemas.messages.radio import Radio
from sim_host.task.judge import BY_TIME
from touchline.learn.episode import Episode
from touchline.learn.sight_space import SightSpace
from touchline.matches.task.task import Task, load_task
from touchline.policy.control import Control
from touchline.policy.entries import Entry
from touchline.policy.interface import SETTINGS, Interface
from touchline.policy.observation import Observation

if TYPE_CHECKING:
    from touchline.drawing.window import Window

Observed = Any
"""A vector of shape (entries,), or a sight."""
Infos = dict[str, dict[str, Any]]
OBSERVATIONS = ("vector", "sight")


class TaskEnv(ParallelEnv):  # type: ignore[misc]  # PettingZoo has no types
    """A team that does a task; every robot gets the team's reward.

    Observations are vectors of `touchline.policy.observation`, or the robots' sights; actions are vectors of
    `touchline.policy.control`. A step lasts `decision_ticks` control ticks. A robot that is sent off stays an agent,
    and its actions have no effect. `terminated` is an end by score or game, `truncated` one by time or `max_cycles`.
    """

    metadata: dict[str, Any] = {
        "name": "touchline",
        "render_modes": ["rgb_array", "human"],
        "render_fps": 10,
        "is_parallelizable": True,
    }

    def __init__(
        self,
        task: str | Path,
        *,
        robots: Sequence[str] | None = None,
        parameters: Mapping[str, Parameter] | None = None,
        overrides: Mapping[str, Any] | None = None,
        observation: str = "vector",
        advice: bool = False,
        max_cycles: int | None = None,
        render_mode: str | None = None,
    ) -> None:
        """An environment of a task that ships, by its name, or of one from the path of its match file.

        Args:
            robots: those of the task's side that are agents, all by default; the others are played by their brain.
            parameters: of the team: settings of `touchline.policy.interface`, or those that its match file names.
            overrides: keys of the match file, with dots, such as `teams.magenta.brain`.
            observation: `vector`, or `sight` for a `schemas.messages.sight.Sight`, whose parts must not be changed.
            advice: infos have the action `advice`: what the brain in the match file would do now in the agent's place.
            max_cycles: steps after which an episode is truncated; None for no such limit.
            render_mode: `rgb_array` for pictures from above by `render`, `human` for a window that shows each step.

        Raises:
            TouchlineError: there is no such task, robot or kind of observation, or the match file is invalid.
        """
        if overrides and "seed" in overrides:
            raise TouchlineError("overrides name the seed, which each episode has its own; give it to reset(seed=…)")
        plain = load_task(task, overrides=overrides)
        known = [*SETTINGS, *plain.config.team(plain.side).parameters]
        if wrong := [name for name in parameters or {} if name not in known]:
            what = f"{wrong[0]!r} is no parameter of a policy, and one of a brain goes into overrides"
            raise TouchlineError(f"{what}; {did_you_mean(wrong[0], known)}")
        given = {f"teams.{plain.side.value}.parameters.{name}": value for name, value in (parameters or {}).items()}
        self._task = load_task(task, overrides={**(overrides or {}), **given})
        if observation not in OBSERVATIONS:
            raise TouchlineError(f'observation is "{observation}"; {did_you_mean(observation, OBSERVATIONS)}')
        modes = self.metadata["render_modes"]
        if render_mode not in (None, *modes):
            raise TouchlineError(f'render_mode is "{render_mode}"; {did_you_mean(render_mode, modes)}')
        if max_cycles is not None and (not isinstance(max_cycles, int | np.integer) or max_cycles < 1):
            raise TouchlineError(f"max_cycles is {max_cycles!r}; give a whole number of steps, or leave it out")
        self.render_mode = render_mode
        self.possible_agents = _agents(self._task, robots)
        self.agents: list[str] = []
        self.max_cycles = max_cycles
        self._cycles = 0
        self._episode: Episode | None = None
        self._window: Window | None = None
        self._seeds = np.random.default_rng()
        self._sights, self._advised = observation == "sight", advice
        self._corrects = Interface.of(self._task.config.team(self._task.side).parameters).corrects
        if advice and self._corrects:
            raise TouchlineError("there is no advice on corrections; leave out advice=True or the parameter corrects")
        self._lay_out()

    def __getstate__(self) -> dict[str, Any]:
        """All but the episode and its window, which belong to this process: a copy begins with `reset`."""
        return {**self.__dict__, "_episode": None, "_window": None, "agents": []}

    def _lay_out(self) -> None:
        """Determine all layouts and spaces, which no episode changes."""
        episode = self._begin(self._task.config.seed, None)
        briefings = {agent: episode.briefing(agent) for agent in self.possible_agents}
        episode.close()
        self._observations = {agent: Observation(briefing) for agent, briefing in briefings.items()}
        self._controls = {agent: Control(briefing) for agent, briefing in briefings.items()}
        self.observation_spaces: dict[str, Space[Any]] = {
            agent: SightSpace() if self._sights else Box(layout.low, layout.high, dtype=np.float32)
            for agent, layout in self._observations.items()
        }
        self.action_spaces: dict[str, Space[Any]] = {
            agent: Box(-1.0, 1.0, (len(control.entries),), np.float32) for agent, control in self._controls.items()
        }

    def observation_space(self, agent: str) -> Space[Any]:
        """The space of an agent's observations: the same object each time."""
        return self.observation_spaces[self._known(agent)]

    def action_space(self, agent: str) -> Space[Any]:
        """The space of an agent's actions: the same object each time."""
        return self.action_spaces[self._known(agent)]

    def observation_entries(self, agent: str) -> tuple[Entry, ...]:
        """Name, unit, scale and limits of each number of an agent's observation."""
        return self._observations[self._known(agent)].entries

    def action_entries(self, agent: str) -> tuple[Entry, ...]:
        """Name, unit and scale of each number of an agent's action."""
        return self._controls[self._known(agent)].entries

    def reset(
        self, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[dict[str, Observed], Infos]:
        """Begin the episode of a seed; without one, of a seed that is drawn after the last given one.

        The option `record` is the path of an MCAP recording of the episode. Infos have the `seed` of the episode.

        Raises:
            TouchlineError: the seed is no whole number from 0 to 2^63 - 1, a brain cannot be loaded, the recording
                cannot be written, or no window can be opened.
        """
        if not isinstance(options, Mapping | None):
            raise TouchlineError(f"options are {options!r}; give a dict, such as {{'record': 'episode.mcap'}}")
        record = (options or {}).get("record")
        if not isinstance(record, str | Path | None):
            raise TouchlineError(f"record is {record!r}; give the path of an MCAP file")
        if seed is None:
            seed = int(self._seeds.integers(2**31))
        elif isinstance(seed, bool) or not isinstance(seed, int | np.integer) or not 0 <= seed < 2**63:
            raise TouchlineError(f"seed is {seed!r}; give a whole number from 0 to 2^63 - 1")
        else:
            self._seeds = np.random.default_rng(seed)
        self._end()
        self._seed = int(seed)
        self._episode = self._begin(self._seed, Path(record) if record is not None else None)
        self.agents, self._cycles = [*self.possible_agents], 0
        self._show(self._episode)
        return self._observe(self._episode), self._infos(self._episode)

    def step(
        self, actions: Mapping[str, Any]
    ) -> tuple[dict[str, Observed], dict[str, float], dict[str, bool], dict[str, bool], Infos]:
        """Keep the actions in force until the next decision; the reward is the sum over the ticks.

        Raises:
            TouchlineError: an agent is unknown or has no action, an action has another shape or is not finite, or no
                episode is going on.
        """
        episode = self._episode
        if episode is None or not self.agents:
            raise TouchlineError("no episode is going on; call reset() first")
        checked = self._checked(actions)
        reward, sights = 0.0, episode.sights
        radio = {agent: self._controls[agent].message(sights[agent]) for agent in self.agents}
        for _ in range(self._controls[self.agents[0]].decision_ticks):
            episode.step(self._commands(episode, checked, radio))
            radio = {}
            reward += episode.state.reward
            if episode.state.over:
                break
        self._cycles += 1
        self._show(episode)
        state, agents = episode.state, self.agents
        terminated = state.over and state.ended_by != BY_TIME
        truncated = not terminated and (state.over or self._cycles == self.max_cycles)
        observed, infos = self._observe(episode), self._infos(episode)
        if terminated or truncated:
            self.agents = []
            episode.close()
        return (
            observed,
            dict.fromkeys(agents, reward),
            dict.fromkeys(agents, terminated),
            dict.fromkeys(agents, truncated),
            infos,
        )

    def state(self) -> NDArray[np.float32]:
        """The observations of all agents, one after the other, as vectors.

        Raises:
            TouchlineError: no episode was begun.
        """
        if self._episode is None:
            raise TouchlineError("no episode was begun; call reset() first")
        sights = self._episode.sights
        return np.concatenate([layout.observe(sights[agent]) for agent, layout in self._observations.items()])

    @property
    def ended_by(self) -> str:
        """What ended the newest episode, by the words of its task; empty while it goes on, or at `max_cycles`."""
        return self._episode.state.ended_by if self._episode is not None else ""

    def render(self) -> NDArray[np.uint8] | None:
        """With `rgb_array` a picture from above, shape (height, width, 3), else None: a window shows steps by itself.

        Raises:
            TouchlineError: no episode was begun, or matplotlib is not installed.
        """
        if self.render_mode != "rgb_array":
            return None
        if self._episode is None:
            raise TouchlineError("no episode was begun; call reset() first")
        return self._episode.picture()

    def close(self) -> None:
        """Free the engine, finish a recording, and close the window; `reset` begins a new episode."""
        self._end()
        if self._window is not None:
            self._window.close()
            self._window = None

    def _show(self, episode: Episode) -> None:
        """Show the world in the window, if there is to be one."""
        if self.render_mode != "human":
            return
        picture = episode.picture()
        if self._window is None:
            from touchline.drawing.window import Window

            self._window = Window(self._task.config.name, picture)
        self._window.show(picture)

    def _end(self) -> None:
        if self._episode is not None:
            self._episode.close()
        self._episode, self.agents = None, []

    def _begin(self, seed: int, recording: Path | None) -> Episode:
        adviser = self._corrects or ("" if self._advised else None)
        return Episode(self._task.episode(seed), self._task.folder, self.possible_agents, recording, adviser)

    def _observe(self, episode: Episode) -> dict[str, Observed]:
        sights = episode.sights
        if self._sights:
            return {agent: sights[agent] for agent in self.agents}
        return {agent: self._observations[agent].observe(sights[agent]) for agent in self.agents}

    def _infos(self, episode: Episode) -> Infos:
        state = episode.state
        # Numbers, as TorchRL requires.
        info: dict[str, Any] = {"seed": self._seed, "tick": episode.tick, "score": state.value or 0.0}
        infos = {agent: dict(info) for agent in self.agents}
        if self._advised:
            for agent, command in episode.advice.items():
                infos[agent]["advice"] = self._controls[agent].action(command)
        return infos

    def _checked(self, actions: Mapping[str, Any]) -> list[tuple[str, NDArray[np.float32]]]:
        for agent in actions:
            self._known(agent)
        checked = []
        for agent in self.agents:
            if agent not in actions:
                raise TouchlineError(f"{agent} has no action; give one for each of {', '.join(self.agents)}")
            entries = self._controls[agent].entries
            try:
                action = np.asarray(actions[agent], np.float32)
            except (TypeError, ValueError):
                raise TouchlineError(
                    f"the action of {agent} is {actions[agent]!r}; give {len(entries)} numbers"
                ) from None
            if action.shape != (len(entries),):
                names = ", ".join(self._controls[agent].names)
                raise TouchlineError(
                    f"the action of {agent} has the shape {action.shape}; it is ({len(entries)},): {names}"
                )
            if not all(map(math.isfinite, action.tolist())):
                raise TouchlineError(f"the action of {agent} is {action.tolist()}; give finite numbers")
            checked.append((agent, action))
        return checked

    def _commands(
        self, episode: Episode, actions: list[tuple[str, NDArray[np.float32]]], radio: Mapping[str, Radio]
    ) -> dict[str, Command]:
        """The commands of one tick. They are made without sights, of which none are made between two decisions."""
        tick, kicker, away = episode.tick, episode.kicker, episode.off_field
        brains = episode.advice if self._corrects else {}
        return {
            agent: self._controls[agent].command(
                action,
                tick,
                off_field=agent in away,
                can_kick=agent == kicker,
                radio=radio.get(agent),
                corrected=brains.get(agent),
            )
            for agent, action in actions
        }

    def _known(self, agent: str) -> str:
        if agent not in self.action_spaces:
            raise TouchlineError(f"{agent!r} is no agent; {did_you_mean(agent, self.possible_agents)}")
        return agent


def _agents(task: Task, robots: Sequence[str] | None) -> list[str]:
    """The robots of a task that are agents: all, or those that are named."""
    if isinstance(robots, str):
        raise TouchlineError(f'robots is "{robots}"; give a list of names')
    chosen = list(dict.fromkeys(task.robots if robots is None else robots))
    for robot in chosen:
        if robot not in task.robots:
            raise TouchlineError(f"{robot} does not do this task; {did_you_mean(robot, task.robots)}")
    if not chosen:
        raise TouchlineError(f"no robot is an agent; name some of {', '.join(task.robots)}")
    return chosen
