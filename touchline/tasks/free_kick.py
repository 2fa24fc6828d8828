"""A free kick before a wall: a goal, or none. Its score, and attackers of the team `simple` that shoot directly."""

from robot_agent.teams.simple import Simple
from touchline import Action, CoachOrder, KickMode, Moment, Score, TeamPhase, WorldBelief, skills

OPEN = 0.5
"""m of free lane into the goal, with which the taker shoots along the ground; otherwise it lobs."""
ERROR = 0.15
"""m beside the target, at most."""
PLAYED = ("free_kick", "play")
"""Phases of an episode."""


def scored(now: Moment) -> Score:
    """1 for a goal, otherwise 0; over with any goal, when a defender has the ball or play stops."""
    lost = now.holder is not None and now.sides[now.holder] != "cyan"
    return Score(float(now.game.score.cyan), over=lost or now.game.phase not in PLAYED)


class Attacker(Simple):
    """Takes the free kick as a shot: along the ground where the lane is open, otherwise over the wall."""

    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """Shoot with the ball of a free kick; otherwise play as `simple` does."""
        if not belief.holding or belief.game.phase is not TeamPhase.OUR_FREE_KICK:
            return super().play(belief, order)
        me, pitch, kicker = belief.me, self.setup.pitch, self.setup.kicker
        y, width = skills.best_place(me[:2], belief.opponents, pitch)
        ground = KickMode.GROUND, kicker.max_ground_speed
        mode, speed = ground if width > OPEN else (KickMode.LOB, kicker.max_lob_speed)
        drive, kick = skills.kick_at(me, (pitch.goal_line, y), speed, ERROR, self.limits, mode)
        return Action("striker", "shoot", drive, dribble=True, kick=kick)
