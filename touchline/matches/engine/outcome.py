"""How a match of a plan ended. An outcome holds no wall time: equal matches have equal outcomes, byte by byte."""

from dataclasses import dataclass, field, replace
from enum import StrEnum
from pathlib import Path

from msgspec import ValidationError

from recordings.soccer.stats.figures import MatchFigures
from schemas.errors import TouchlineError
from schemas.side import Side
from schemas.wire.part import decoder
from touchline.matches.judging.judge import DrillVerdict


class FailureKind(StrEnum):
    """Why a match was not played to its end."""

    DID_NOT_START = "did_not_start"
    """A team could not be loaded, or none of its robots came."""
    CRASHED = "crashed"
    """A brain raised an exception, or no robot of a team was left."""
    HUNG = "hung"
    """A brain, or each robot of a team, did not answer."""
    BROKE_ACCESS_RULES = "broke_access_rules"
    """A team sent more than the limits of its account allow."""
    WORKER = "worker"
    """The process or the machine that played the match was lost, or could not play it: it is played again when the
    run goes on."""


@dataclass(frozen=True, slots=True)
class Played:
    """A match that was played to its end."""

    identity: str
    figures: MatchFigures | None
    """The figures of `touchline stats`; None for a game without goals."""
    playing_time: float
    """Game clock at the end less that at the beginning, in s."""
    chain: str
    """The hash chain over all states: equal for equal matches."""
    recording: str | None = None
    """The file of its recording; relative to the folder of the run if it is in there."""
    verdict: DrillVerdict | None = None
    """How a drill ended; None for a match, and for a drill that was over without a verdict."""
    value: float | None = None
    """The score of a game without goals."""
    missed: dict[str, int] = field(default_factory=dict)
    """Robot → sights that it did not answer, in lockstep: the match does not depend on its seed alone."""
    events: dict[str, int] = field(default_factory=dict)
    """What happened, as `foul:cyan (charging)` → how often."""

    @property
    def of_soccer(self) -> MatchFigures:
        """The figures of a match of soccer.

        Raises:
            TouchlineError: another game was played.
        """
        if self.figures is None:
            raise TouchlineError("a free game has no goals to compare; measure it with touchline experiment")
        return self.figures

    @property
    def goals(self) -> dict[Side, int]:
        """The goals of each side."""
        sides = self.figures.sides if self.figures is not None else {}
        return {side: sides[side].goals or 0 if side in sides else 0 for side in Side}


@dataclass(frozen=True, slots=True)
class Failed:
    """A match that was not played to its end."""

    identity: str
    kind: FailureKind
    reason: str
    """One line that names robot, tick, file and line where they are known."""
    culprits: tuple[Side, ...] = ()
    """The sides whose programs are the reason; none if neither is, or nobody knows."""
    evidence: str | None = None
    """The file or folder that shows it, as the recording's."""


Outcome = Played | Failed


def relative_to(outcome: Outcome, folder: Path) -> Outcome:
    """The outcome with paths that hold where this folder is moved; those outside of it stay."""
    if isinstance(outcome, Failed):
        return replace(outcome, evidence=_relative(outcome.evidence, folder))
    return replace(outcome, recording=_relative(outcome.recording, folder))


def _relative(path: str | None, folder: Path) -> str | None:
    if path is None or not Path(path).resolve().is_relative_to(folder.resolve()):
        return path
    return Path(path).resolve().relative_to(folder.resolve()).as_posix()


def from_json(text: bytes) -> Outcome:
    """The outcome that was encoded."""
    try:
        outcome: Outcome = decoder(Played).decode(text)
    except ValidationError:
        outcome = decoder(Failed).decode(text)
    return outcome
