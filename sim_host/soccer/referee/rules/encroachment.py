"""Encroachment: between START and the ball in play, a robot comes nearer to the restart than it may.

An opponent's encroachment repeats the restart; a teammate's gives it to the other side. At a kick-off, a robot other
than the taker encroaches on the other half, too. The distances are those before START, with the same exceptions. It
makes no difference for how long a robot is too near. A robot that was too near at START, because START did not wait for
it, or that an opponent pushed there has time to retreat, and encroaches if it comes nearer again.

Section: restarts.
Measures: the distance between the ball's spot and the robot's hull, or how far its hull is in the other half, from
START until the ball is in play.
Not judged: penalties, which have positions of their own; whether the encroachment helped.
"""

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.set_piece import Intrusion
from sim_host.soccer.referee.offence_order import worst_first
from sim_host.soccer.referee.placement.positions import distance_violations
from sim_host.soccer.referee.rules.foul import CARDS, exceeds
from sim_host.soccer.referee.rules.set_piece_foul import being_taken, given_away, restart_foul
from sim_host.soccer.referee.situation import Situation, is_encroachment_judged


def judge(situation: Situation) -> Decision | None:
    """The same restart again, or the restart for the other side, or None."""
    piece = being_taken(situation)
    if piece is None or not piece.intrusions or not is_encroachment_judged(situation.match, situation.state):
        return None
    roster, numbers = situation.match.roster, situation.match.book.restarts
    for intrusion in worst_first(situation, piece.intrusions, lambda one: one.depth, lambda one: one.robot):
        if not _encroaches(intrusion, numbers.encroach_margin, numbers.encroach_retreat):
            continue
        name, side = roster.names[intrusion.robot], roster.sides[intrusion.robot]
        violation = distance_violations(situation.match, situation.state, piece.restart, situation.snapshot)[
            intrusion.robot
        ]
        is_mate = side is piece.restart.side
        who = "a teammate of the taker" if is_mate else "an opponent"
        late = f", {intrusion.lasted:.1f} s after START" if intrusion.excused else ""
        robot = situation.snapshot.robots[intrusion.robot]
        return restart_foul(
            situation,
            name,
            f"{name}, {who}, encroached before the ball was in play: {violation.phrase}{late}",
            given_away(situation, piece) if is_mate else piece.restart,
            (violation.measured, violation.limit, "m"),
            (robot.x, robot.y),
            CARDS[situation.match.book.fouls.encroachment],
        )
    return None


def _encroaches(intrusion: Intrusion, margin: float, retreat: float) -> bool:
    """Whether a robot is too near by its own fault."""
    if not exceeds(intrusion.depth, margin):
        return False
    return (
        not intrusion.excused
        or exceeds(intrusion.depth, intrusion.least + margin)
        or exceeds(intrusion.lasted, retreat)
    )
