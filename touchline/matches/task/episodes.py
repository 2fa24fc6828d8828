"""The episodes of a task as matches of a plan, and their scores."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from touchline.matches.engine.outcome import Failed, Outcome, Played
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.statistics.estimates import Estimate, mean
from touchline.matches.task.task import Task


@dataclass(frozen=True, slots=True)
class PlayedEpisode:
    """How an episode ended."""

    seed: int
    score: float
    time: float
    """Game clock in s at its end, less that at its beginning."""
    chain: str
    """The hash chain over all states."""


@dataclass(frozen=True, slots=True)
class FailedEpisode:
    """An episode that was not played to its end, such as one in which a brain raised."""

    seed: int
    reason: str


@dataclass(frozen=True, slots=True)
class TaskResult:
    """What came of the episodes of a task."""

    task: str
    unit: str
    planned: int
    """Episodes that were to be played."""
    score: Estimate | None
    """The mean score with its interval of 95 %; None without an episode."""
    least: float | None
    most: float | None
    time: float | None
    """Simulated time of an episode in s, on average."""
    episodes: list[PlayedEpisode]
    """By seed."""
    failed: list[FailedEpisode]


def episodes_of(task: Task, seeds: Iterable[int]) -> list[PlannedMatch]:
    """One match for each seed."""
    return [
        PlannedMatch(task.episode(seed), brain_folder=task.folder, label=f"{task.name}, seed {seed}") for seed in seeds
    ]


def result_of(task: Task, planned: Sequence[PlannedMatch], outcomes: Mapping[str, Outcome]) -> TaskResult:
    """The scores of the episodes that have ended."""
    episodes, failed = [], []
    for one in planned:
        outcome, seed = outcomes.get(one.identity), one.config.seed
        if isinstance(outcome, Played) and outcome.value is not None:
            episodes.append(PlayedEpisode(seed, outcome.value, outcome.playing_time, outcome.chain))
        elif isinstance(outcome, Failed):
            failed.append(FailedEpisode(seed, outcome.reason))
    scores = [one.score for one in episodes]
    return TaskResult(
        task=task.name,
        unit=task.unit,
        planned=len(planned),
        score=mean(scores),
        least=min(scores, default=None),
        most=max(scores, default=None),
        time=sum(one.time for one in episodes) / len(episodes) if episodes else None,
        episodes=episodes,
        failed=failed,
    )
