"""The health of the host and its agents, and invalid payloads."""

from typing import Annotated

from msgspec import Meta

from schemas.messages.latency_counts import CLASSES
from schemas.side import Side
from schemas.wire.message import Message, Name
from schemas.wire.part import Part

MAX_FAULT = 300
"""Most characters of a fault."""


class RobotHealth(Part):
    """State of one robot's agent; counts are since the match began."""

    alive: bool = False
    """Its liveliness token exists."""
    answering: bool = False
    """Its answer to the last tick arrived in time."""
    answers: int = 0
    """Ticks with an answer."""
    missed: int = 0
    """Ticks without an answer."""
    missed_in_a_row: int = 0
    """Newest ticks without an answer, one after the other."""
    duplicates: int = 0
    """Commands for a tick that it had already answered."""
    invalid: int = 0
    """Payloads on its key that were not valid commands."""
    removed: bool = False
    """Its robot was removed from the pitch: it gets no sights, and the host does not wait for it, until the robot is
    added again."""
    still: bool = False
    """Its robot stands still in the current scene: its commands have no effect, and the host does not wait for them."""
    refused: int = 0
    """Parts of commands that were refused."""
    latency_ms: float | None = None
    """Median wall time from sight to command over the last second, in ms; None without an answer."""
    sights: int = 0
    """Sights sent to its agent while it was present, without repetitions."""
    unanswered: int = 0
    """Sights without an answer before the newest one that was answered: the sight was lost, the agent skipped it for a
    newer one, or its answer was lost or invalid."""
    late: int = 0
    """Those of `answers` to a sight that was no longer the newest; the others were on time."""
    lost_commands: int = 0
    """Commands that did not reach the host, by the gaps in the agent's sequence numbers."""
    radio_bytes: int = 0
    """Bytes of its radio messages that were sent."""
    radio_refused: int = 0
    """Its radio messages that were refused, by the team's budget or by a channel in use."""
    latencies: Annotated[list[int], Meta(max_length=CLASSES)] = []
    """Answers by wall time from sight to command: the first number counts those below 0.125 ms, and each class reaches
    to 2^¼ times the end of the one before. Trailing zeros are left out."""
    fault: Annotated[str, Meta(max_length=MAX_FAULT)] = ""
    """Why its messages are not answers to the newest sight; empty if it answers, or if nothing comes from it."""


class TeamRadio(Part):
    """Use of one team's radio."""

    budget: float
    """Most bits that the team may send in a second, in bit/s."""
    busiest: float = 0.0
    """Bits that the team sent in its busiest second since the match began, in bit/s."""


class AccountHealth(Part):
    """What one account has sent; counts are since the match began."""

    messages: int = 0
    """Messages that reached the host. The router drops what is far above the limits before that, without a count."""
    size: int = 0
    """Bytes of these messages."""
    dropped: dict[str, int] = {}
    """Reason → messages that were dropped for it."""


class Health(Message):
    """State of the host, its agents and recorders."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    pace: str
    """`lockstep`, `realtime`, `x4` for four times real time, or `no host`."""
    real_time_factor: float
    """Simulated seconds per wall second, over the last second."""
    paused: bool = False
    """An operator has paused the match."""
    late_ticks: int = 0
    """Ticks that began late; in lockstep, ticks without all answers in time."""
    worst_tick_ms: float = 0.0
    """Longest wall time of a tick in the last second, in ms."""
    robots: dict[Name, RobotHealth] = {}
    """Robot → the state of its agent."""
    strangers: dict[str, int] = {}
    """Command key → messages on it, for names that no robot of this match has."""
    recorders: dict[Name, Annotated[int, Meta(ge=0)]] = {}
    """Recorder → ticks that it is behind."""
    radio: dict[Side, TeamRadio] = {}
    """Side → use of its radio."""
    accounts: dict[str, AccountHealth] = {}
    """Account → what it has sent; without credentials, each key counts as an account of its own."""


class Invalid(Message):
    """An invalid payload that the host received, counted and ignored."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    key: str
    """Key below the match that the payload was published on."""
    reason: str
    """What is wrong with the payload, in one sentence."""
    size: int
    """Length of the payload in bytes."""
