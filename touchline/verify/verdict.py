"""The verdict on a recording that was simulated again."""

from dataclasses import dataclass, field
from typing import Any

from recordings.reading.tick_index import SkippedTicks, SkipReason


@dataclass(frozen=True, slots=True)
class Detail:
    """One value that differs from the recording."""

    of: str
    """`cyan2`, `ball`, `world`, `game/state`, `game/event goal`; `input of cyan2` and `belief of cyan2` where these and
    the recorded command differ."""
    field: str
    recorded: Any
    simulated: Any
    """For an input: the value in the command."""
    by: float | None = None
    """Absolute difference if both values are numbers: m, m/s, rad or rad/s."""


@dataclass(frozen=True, slots=True)
class Discrepancy:
    """The first tick that differs from the recording."""

    tick: int
    time: float
    """Simulated time, s."""
    why: str
    details: list[Detail] = field(default_factory=list)


@dataclass(slots=True)
class Verdict:
    """The result of verifying a recording."""

    ticks: int = 0
    """Number of ticks that were simulated again and are identical."""
    seconds: float = 0.0
    """Simulated time of these ticks, s."""
    took: float = 0.0
    """Wall time of the verification, s."""
    kick_offs: int = 0
    """Number in the whole recording."""
    processes: int = 1
    other_machine: dict[str, tuple[str, str]] = field(default_factory=dict)
    """Part of the fingerprint → recorded value, value here; only parts that differ."""
    other_program: str = ""
    """How the program that recorded the match differs from this one, and which one would verify it; empty if it does
    not differ."""
    difference: Discrepancy | None = None
    left_out: list[SkippedTicks] = field(default_factory=list)
    without_world: int = 0
    """Ticks without a recorded `world`: only their hash chain was compared."""

    referee: bool = False
    """The referee was simulated, too: events, states of the game, and what follows from them were compared."""
    contradictions: list[str] = field(default_factory=list)
    """Sentences on where the recording does not fit itself: its result, its manifest, its messages."""
    not_checked: list[str] = field(default_factory=list)
    """What is recorded and was not compared."""

    @property
    def identical(self) -> bool:
        """True if at least one tick was compared, no tick differs, and no tick in between is missing."""
        return (
            self.ticks > 0
            and self.difference is None
            and not self.contradictions
            and all(one.why is not SkipReason.MISSING for one in self.left_out)
        )
