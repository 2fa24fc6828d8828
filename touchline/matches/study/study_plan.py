"""The plan of a study: which matches are due, as a pure function of the outcomes so far."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import count, islice
from pathlib import Path

import pandas as pd

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from touchline.matches.engine.inputs_only import with_inputs_only
from touchline.matches.engine.outcome import Outcome
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.series.plan import SeedMatch, with_sides_swapped
from touchline.matches.statistics.paired import widest
from touchline.matches.study.cells import Cell
from touchline.matches.study.match_figures import Value
from touchline.matches.study.result_table import COUNTS, result_table
from touchline.matches.study.sentences import sentence_of_missing
from touchline.matches.study.study_config import Study

RECORDINGS = "recordings"
"""The folder of the recordings, in a study's folder."""
LOGS = "logs"
"""The folder of the logs of matches that failed, in a study's folder."""


@dataclass(frozen=True)
class StudyPlan:
    """A study, and its cells with their matches."""

    study: Study
    cells: Sequence[Cell]
    brain_folder: Path | None = None
    """Where brains and functions are looked for first."""
    folder: Path | None = None
    """The folder of the study, which gets recordings, where it wants any, and logs; None for neither."""
    measured: dict[str, Mapping[str, Value]] = field(default_factory=dict, repr=False, compare=False)
    """Identity of a match → values of the study's functions."""
    _of_seeds: dict[int, tuple[SeedMatch, ...]] = field(init=False, default_factory=dict, repr=False, compare=False)
    _known: set[str] = field(init=False, default_factory=set, repr=False, compare=False)
    """Names of the figures of the first seed's matches, once these were played."""
    _narrow: dict[int, bool] = field(init=False, default_factory=dict, repr=False, compare=False)
    """Number of seeds, all of which were played → whether the interval is narrow enough, or none ever will be."""

    def due(self, outcomes: Mapping[str, Outcome]) -> list[PlannedMatch]:
        """All matches that can be played now and have no outcome; none when the study is complete.

        Raises:
            TouchlineError: the matches of the first seed have no figure of the name of a response.
        """
        self._check_responses(outcomes)
        matches = self.matches(self.seeds_due(outcomes))
        distinct = {one.identity: one for one in matches}
        return [one.planned for identity, one in distinct.items() if identity not in outcomes]

    def seeds_due(self, outcomes: Mapping[str, Outcome]) -> list[int]:
        """The seeds to be played, in view of the outcomes so far.

        With `until_interval`, as many seeds as at first are added whenever all are played and the interval is too wide.
        """
        first = self.study.first_seeds
        if self.study.until_interval is None:
            return first
        number, most = len(first), max(self.study.most_seeds, len(first))
        while number < most:
            seeds = self._all_seeds[:number]
            matches = self.matches(seeds)
            if any(one.identity not in outcomes for one in matches):
                break
            if number not in self._narrow:
                width = widest(self.table(seeds, outcomes), self.study.primary, self.study.matches_of_seed)
                self._narrow[number] = width is not None and width <= self.study.until_interval
            if self._narrow[number]:
                break
            number = min(most, number + len(first))
        return self._all_seeds[:number]

    def matches(self, seeds: Sequence[int]) -> list[SeedMatch]:
        """The matches of these seeds, seed by seed, so that pairs are complete early."""
        for seed in seeds:
            if seed not in self._of_seeds:
                self._of_seeds[seed] = tuple(self._of_seed(seed))
        return [match for seed in seeds for match in self._of_seeds[seed]]

    def table(self, seeds: Sequence[int], outcomes: Mapping[str, Outcome]) -> pd.DataFrame:
        """The results of these seeds, one row a match."""
        return result_table(self.matches(seeds), self.cells, outcomes, self.measured)

    def _check_responses(self, outcomes: Mapping[str, Outcome]) -> None:
        seeds = self.study.first_seeds[:1]
        if not self._known and all(one.identity in outcomes for one in self.matches(seeds)):
            self._known.update(self.table(seeds, outcomes))
            for name in self.study.responses if "duration" in self._known else ():  # one was played
                if name not in self._known and not any(part in name for part in COUNTS):
                    raise TouchlineError(sentence_of_missing(name, sorted(self._known)))

    def _of_seed(self, seed: int) -> Iterator[SeedMatch]:
        for number, cell in enumerate(self.cells):
            for swapped in (False, True) if self.study.both_sides else (False,):
                config = with_sides_swapped(cell.config) if swapped else cell.config
                label = f"cell {number + 1}, seed {seed}{', sides swapped' if swapped else ''}"
                yield SeedMatch(self._planned(config.model_copy(update={"seed": seed}), label), swapped, number)

    def _planned(self, config: MatchConfig, label: str) -> PlannedMatch:
        """The match as it is played."""
        study, folder = self.study, self.folder
        kept = with_inputs_only(config) if study.record == "inputs" else config
        planned = PlannedMatch(kept, way=study.way, brain_folder=self.brain_folder, label=label)
        if folder is None:
            return planned
        recording = folder / recording_name(planned.identity) if study.record or study.functions else None
        return replace(planned, recording=recording, logs=folder / LOGS / planned.identity)

    @cached_property
    def _all_seeds(self) -> list[int]:
        """The seeds of the study file, and those that are added to them in order."""
        first = self.study.first_seeds
        return [*first, *islice(count(max(first) + 1), max(0, self.study.most_seeds - len(first)))]


def recording_name(identity: str) -> str:
    """Path of the recording of a match in the folder of its study."""
    return f"{RECORDINGS}/{identity}.mcap"
