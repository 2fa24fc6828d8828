"""What the referee has seen since START: pure functions over ticks, one idea a file, from contacts, kicks and poses.

Knows no rule: the rules compare what is kept here with the numbers of the rule book. A part that nothing happened to
stays the same object, so that a quiet tick makes nothing new.
"""

from typing import NamedTuple

from sim_host.referee.evidence.contest import Contest, contest_after
from sim_host.referee.evidence.dribble import Dribble, dribble_after
from sim_host.referee.evidence.flight import Flight, flight_after
from sim_host.referee.evidence.outside import outside_after
from sim_host.referee.evidence.play import NO_TOUCHES, Play, play_after
from sim_host.referee.evidence.pushes import Push, pushes_after
from sim_host.referee.evidence.stays import NO_STAYS, Stays, stays_after
from sim_host.referee.evidence.zones import find_zones
from sim_host.referee.match_constants import MatchConstants
from sim_host.snapshot import Snapshot


class Evidence(NamedTuple):
    """Everything seen since START; times in s, places in m in the field frame."""

    play: Play = NO_TOUCHES
    """Touches, control and passes."""
    dribble: Dribble | None = None
    """The robot that has caught the ball and not visibly released it."""
    flight: Flight | None = None
    """The last kick, until somebody touches the ball or a lob has landed."""
    stays: Stays = NO_STAYS
    """How long robots have been in areas where they may not stay."""
    pushes: tuple[Push, ...] = ()
    """Robots of different sides that lean on each other."""
    contest: Contest | None = None
    """Both sides at the ball."""
    outside: tuple[tuple[int, float], ...] = ()
    """Robots that are wholly outside the lines, by their index in the roster, and since how many s."""


NO_EVIDENCE = Evidence()
"""Before START."""


def evidence_after(
    match: MatchConstants,
    before: Evidence,
    is_keeper: tuple[bool, ...],
    cyan_attacks: int,
    snapshot: Snapshot,
    dt: float,
) -> Evidence:
    """The evidence after one more tick of `dt` in s; who keeps a goal, and the sign of the x that cyan attacks."""
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
    stays = before.stays
    if zones.deep or stays.robots or stays.crowds:
        stays = stays_after(match, stays, zones, snapshot, dt)
    pushes = before.pushes
    if pushes or snapshot.contacts:
        pushes = pushes_after(match, pushes, snapshot, dt)
    outside = before.outside
    if outside or zones.outside:
        outside = outside_after(outside, zones, dt)
    if (
        play is before.play
        and dribble is before.dribble
        and flight is before.flight
        and stays is before.stays
        and pushes is before.pushes
        and contest is before.contest
        and outside is before.outside
    ):
        return before
    return Evidence(play, dribble, flight, stays, pushes, contest, outside)
