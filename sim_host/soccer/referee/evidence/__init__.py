"""Evidence that the referee collects since START, from contacts, kicks and poses: pure functions, one idea a file.

Evidence knows no rules: the rules compare it with the numbers of the rule book. A part that does not change stays the
same object, so that a quiet tick creates no objects.
"""

from typing import NamedTuple

from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.evidence.contest import Contest, contest_after
from sim_host.soccer.referee.evidence.dribble import Dribble, dribble_after
from sim_host.soccer.referee.evidence.flight import Flight, flight_after
from sim_host.soccer.referee.evidence.outside import outside_after
from sim_host.soccer.referee.evidence.play import NO_TOUCHES, Play, play_after
from sim_host.soccer.referee.evidence.progress import Progress, progress_after
from sim_host.soccer.referee.evidence.pushes import Push, pushes_after
from sim_host.soccer.referee.evidence.shoves import NO_SHOVES, Shove, shoves_after
from sim_host.soccer.referee.evidence.stays import NO_STAYS, Stays, stays_after
from sim_host.soccer.referee.evidence.zones import find_zones
from sim_host.soccer.referee.match_constants import MatchConstants


class Evidence(NamedTuple):
    """All evidence since START; times in s, places in m in the field frame."""

    play: Play = NO_TOUCHES
    """Touches, control and passes."""
    dribble: Dribble | None = None
    """The robot that has caught the ball and not visibly released it."""
    flight: Flight | None = None
    """The last kick, until the ball is touched or a lob has landed."""
    stays: Stays = NO_STAYS
    """Clocks of robots in goal areas and penalty areas."""
    pushes: tuple[Push, ...] = ()
    """Pairs of robots of different sides that lean on each other."""
    contest: Contest | None = None
    """The contest while both sides are at the ball."""
    outside: tuple[tuple[int, float], ...] = ()
    """Clocks in s of robots that are or were wholly outside the lines, by their index in the roster."""
    shoves: tuple[Shove, ...] = NO_SHOVES
    """Robots that another robot has hit within the last second, the oldest first."""
    progress: Progress | None = None
    """The circle that the ball in play has to leave."""


NO_EVIDENCE = Evidence()
"""The evidence before START."""


def evidence_after(
    match: MatchConstants,
    before: Evidence,
    is_keeper: tuple[bool, ...],
    cyan_attacks: int,
    snapshot: Snapshot,
    dt: float,
    *,
    in_play: bool,
) -> Evidence:
    """The evidence after one more tick of `dt` in s.

    `is_keeper` is per robot of the roster; `cyan_attacks` is the sign of the x direction that cyan attacks; `in_play`
    is whether the ball was in play before this tick.
    """
    zones = find_zones(match, is_keeper, cyan_attacks, snapshot)
    play = play_after(match, before.play, cyan_attacks, snapshot) if snapshot.touches else before.play
    contest = before.contest
    if contest is not None or len(zones.near) > 1:
        contest = contest_after(match, contest, zones, snapshot, dt)
    dribble = before.dribble
    if dribble is not None or snapshot.possession is not None:
        dribble = dribble_after(match, dribble, contest, snapshot, dt)
    flight = before.flight
    if flight is not None or snapshot.kicked is not None:
        flight = flight_after(match, flight, snapshot)
    shoves = before.shoves
    if (shoves or snapshot.impacts) and match.book.fouls.charging != "off":
        shoves = shoves_after(shoves, snapshot, dt)
    stays = before.stays
    if zones.deep or stays is not NO_STAYS:
        stays = stays_after(match, stays, zones, shoves, snapshot, dt)
    pushes = before.pushes
    if pushes or snapshot.contacts:
        pushes = pushes_after(match, pushes, snapshot, dt)
    outside = before.outside
    if outside or zones.outside:
        outside = outside_after(match, outside, zones, dt)
    progress = before.progress
    if in_play:
        progress = progress_after(match, progress, dribble, snapshot)
    if (
        play is before.play
        and dribble is before.dribble
        and flight is before.flight
        and stays is before.stays
        and pushes is before.pushes
        and contest is before.contest
        and outside is before.outside
        and shoves is before.shoves
        and progress is before.progress
    ):
        return before
    return Evidence(play, dribble, flight, stays, pushes, contest, outside, shoves, progress)
