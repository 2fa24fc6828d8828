"""Plays a scene in this process with given brains and seeds."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from math import nan
from pathlib import Path
from typing import Any

import numpy as np

from recordings.soccer.stats.match_tick import MatchTick
from schemas.config.match_config import MatchConfig
from schemas.config.scene import Scene, load_scene
from schemas.config.shipped_teams import brain_of
from schemas.messages.command import Command
from schemas.messages.soccer.game import GameEvent
from schemas.side import Side
from touchline.matches.drill.drill_match import drill_match
from touchline.matches.engine.tick_messages import played_ticks
from touchline.matches.judging.judge import verdict_of
from touchline.matches.judging.occurrences import Occurrence, OccurrenceTracker
from touchline.play.play_match import BrainSource, InProcessMatch
from touchline.testing.facts import Facts
from touchline.testing.runs import Runs

DEFAULT_SECONDS = 10.0
"""Time in s for which a scene is played that has no verdict, if none is given."""
DEFAULT_TEAM = "simple"


class ScenePlayer:
    """Plays scenes: call it, or its method `over` for many seeds."""

    def __init__(self, folder: Path | None = None) -> None:
        """Scenes and brains are looked for in `folder`, such as a test's, and then in the current directory."""
        self._folder = folder

    def __call__(
        self,
        scene: str | Scene,
        *,
        seed: int = 1,
        seconds: float | None = None,
        cyan: BrainSource = DEFAULT_TEAM,
        magenta: BrainSource = DEFAULT_TEAM,
        settings: Mapping[str, Any] | None = None,
        **brains: BrainSource,
    ) -> Facts:
        """Play a scene for `seconds`; by default to its verdict, or 10 s if it has none.

        Args:
            scene: name of a scene, path of a file, or a `Scene`.
            seed: determines noise, and the start within the scene's `[[vary]]`: equal seeds give equal runs.
            seconds: simulated time.
            cyan: team of cyan's robots: name of a shipped team, `module:Class`, or a class.
            magenta: the same for magenta.
            settings: further keys of a match file, with dots: `{"radio.loss": 0.2}`.
            brains: robot → its own brain: `cyan2="my_team:Striker"`, a class, or a brain.

        Raises:
            TouchlineError: the scene, a setting or a brain is invalid.
        """
        teams = {Side.CYAN: cyan, Side.MAGENTA: magenta}
        named = {side: brain_of(team if isinstance(team, str) else DEFAULT_TEAM) for side, team in teams.items()}
        start = load_scene(self._place(scene)) if isinstance(scene, str) else scene
        config = drill_match(start, seed, named, dict(settings or {}))
        given = {
            robot: team for side, team in teams.items() if not isinstance(team, str) for robot in config.robots(side)
        }
        return self._played(start, config, given | brains, seconds)

    def over(self, scene: str | Scene, *, seeds: Iterable[int], **options: Any) -> Runs:
        """Play a scene once for each seed, with the options of a single call."""
        return Runs([self(scene, seed=seed, **options) for seed in seeds])

    def _place(self, scene: str) -> str:
        """A scene's file in the test's folder, if there is one of this name."""
        beside = self._folder / scene if self._folder is not None and scene.endswith(".toml") else None
        return str(beside) if beside is not None and beside.exists() else scene

    def _played(
        self, scene: Scene, config: MatchConfig, brains: Mapping[str, BrainSource], seconds: float | None
    ) -> Facts:
        match = InProcessMatch(config, brains, self._folder)
        try:
            tracker, log = OccurrenceTracker(match.simulation.setup()), _Log(match)
            wanted = seconds if seconds is not None or scene.drill is not None else DEFAULT_SECONDS
            verdict = None
            for tick in played_ticks(match, lambda _: log.add_commands()):
                occurrences = tracker.update(tick)
                log.watch(tick, occurrences)
                if verdict is None and scene.drill is not None:
                    verdict = verdict_of(scene.drill, tick.world.time, occurrences)
                if tick.world.time >= wanted - 1e-9 if wanted is not None else verdict is not None:
                    break
            log.occurrences += tracker.end()
            return Facts(
                scene=scene.name,
                seed=config.seed,
                verdict=verdict,
                score=match.simulation.state.score,
                pitch=match.simulation.profile.field,
                events=log.events,
                occurrences=log.occurrences,
                kicks=list(tracker.kicks),
                times=np.array(log.times),
                ball=np.array(log.ball),
                robots={name: np.array(way) for name, way in log.robots.items()},
                commands={name: given[: len(log.times)] for name, given in log.commands.items()},
            )
        finally:
            match.close()


@dataclass(slots=True)
class _Log:
    """Follows a match, tick by tick."""

    match: InProcessMatch
    events: list[GameEvent] = field(default_factory=list)
    occurrences: list[Occurrence] = field(default_factory=list)
    times: list[float] = field(default_factory=list)
    ball: list[tuple[float, float, float]] = field(default_factory=list)
    robots: dict[str, list[tuple[float, float, float]]] = field(default_factory=dict)
    commands: dict[str, list[Command]] = field(default_factory=dict)

    def watch(self, tick: MatchTick, occurrences: Sequence[Occurrence]) -> None:
        """Add a tick."""
        world = tick.world
        for name, robot in world.robots.items():
            way = self.robots.setdefault(name, [(nan, nan, nan)] * len(self.times))
            way.append((nan, nan, nan) if robot.off_field is not None else (robot.x, robot.y, robot.heading))
        self.times.append(world.time)
        self.ball.append((world.match_ball.x, world.match_ball.y, world.match_ball.z))
        self.events.extend(tick.events)
        self.occurrences.extend(occurrences)

    def add_commands(self) -> None:
        """Add the commands of the newest tick, which may be a tick or two ahead of what is watched."""
        for name, command in self.match.commands.items():
            self.commands.setdefault(name, []).append(command)
