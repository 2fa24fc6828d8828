"""One robot of a team that keeps the rules and otherwise acts at random.

Each robot draws what it does next and for how long: drive to a place, go for the ball, or, with the ball, carry it
somewhere or kick it anywhere. The draws depend on the robot's number alone, so that equal matches stay equal.
"""

import math
from random import Random as Draws
from typing import NamedTuple

from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.skills.avoid import circles
from robot_agent.sdk.world_model import WorldBelief
from robot_agent.soccer.skills.dribble_to import dribble_to
from robot_agent.soccer.skills.kick_at import kick_at
from robot_agent.teams.action import Action
from robot_agent.teams.keeper import fetch
from robot_agent.teams.player import Player
from robot_agent.teams.set_piece import stand, step_in, wait_behind
from schemas.frames import Point
from schemas.messages.coach import CoachOrder
from schemas.messages.command import KickMode
from schemas.soccer.game import TeamPhase

LASTS = (1.0, 4.0)
"""s for which a robot goes on with what it has drawn, at least and at most."""
GOES_FOR_BALL = 0.35
"""Share of the draws in which a robot without the ball goes for it."""
KICKS = 0.6
"""Share of the draws in which a robot with the ball kicks it."""
LOBS = 0.2
"""Share of the kicks that are lobs."""
SLOWEST = 3.0
"""m/s of a kick, at least: enough for a restart to be in play."""
ERROR = 0.5
"""m beside the target, at most."""
STAYS = 0.5
"""m by which a teammate must be nearer to a restart than its taker, to take it instead."""
_INSET = 1.0
"""m between drawn places and the lines."""
TAKES, ROAMS, KEEPS = "takes the restart", "roams", "keeper"


class Whim(NamedTuple):
    """What a robot has drawn, and until when."""

    place: Point
    """Where it drives, or at what it kicks, m."""
    goes_for_ball: bool
    kicks: bool
    lobs: bool
    speed: float
    """m/s of the kick."""
    left: float
    """s."""


class Random(Player):
    """One of up to eleven robots."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self._draws = Draws(briefing.number)
        self._whim = self._draw()
        self._held = False
        self._role = ROAMS

    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """Go on with what was drawn, within what the phase allows."""
        del order
        ball, game = belief.ball, belief.game
        in_play = game.phase is TeamPhase.PLAY
        if in_play:  # in a restart it stays with one place, and is there at START
            self._whim = self._whim._replace(left=self._whim.left - belief.dt)
            if self._whim.left < 0.0 or belief.holding is not self._held:
                self._whim = self._draw()
        self._held = belief.holding
        if self.is_keeper:
            return self._keep(belief)
        spot = (
            (game.spot.x, game.spot.y) if game.spot is not None else (ball.now[:2] if ball is not None else (0.0, 0.0))
        )
        if game.phase.ours and ball is not None and self._takes(belief, spot):
            return self._take_restart(belief, ball.now[:2], spot)
        self._role = ROAMS
        if in_play and belief.holding:
            return self._with_ball(belief)
        if in_play and ball is not None and self._whim.goes_for_ball:
            motion = fetch(belief, ball.now, self.setup, self.limits)
            return Action(ROAMS, "go for the ball", motion, dribble=True)
        motion = stand(belief.me, self._whim.place, game, spot, belief.others, self.setup, self.limits)
        return Action(ROAMS, "drive about", motion)

    def _draw(self) -> Whim:
        """Something else to do."""
        draws, pitch = self._draws, self.setup.pitch
        far, wide = pitch.goal_line - pitch.penalty_area_depth - _INSET, pitch.touch_line - _INSET
        return Whim(
            place=(draws.uniform(-far, far), draws.uniform(-wide, wide)),
            goes_for_ball=draws.random() < GOES_FOR_BALL,
            kicks=draws.random() < KICKS,
            lobs=draws.random() < LOBS,
            speed=draws.uniform(SLOWEST, self.setup.kicker.max_ground_speed),
            left=draws.uniform(*LASTS),
        )

    def _with_ball(self, belief: WorldBelief) -> Action:
        """Kick the ball at the drawn place, or carry it there."""
        whim, me = self._whim, belief.me
        if whim.kicks:
            mode = KickMode.LOB if whim.lobs else KickMode.GROUND
            motion, kick = kick_at(me, whim.place, whim.speed, ERROR, self.limits, mode)
            return Action(ROAMS, "kick", motion, dribble=True, kick=kick)
        facing = math.atan2(whim.place[1] - me.y, whim.place[0] - me.x)
        blocked = circles(belief.others, 2.0 * self.setup.robot.reach + self.setup.ball.radius)
        return Action(ROAMS, "carry", dribble_to(me, *whim.place, facing, blocked, self.limits), dribble=True)

    def _takes(self, belief: WorldBelief, spot: Point) -> bool:
        """Whether this robot is the nearest to the restart, with a bonus for the one that takes it already."""
        mine = math.dist(spot, belief.me[:2]) - (STAYS if self._role == TAKES else 0.0)
        others = [
            (math.dist(spot, mate.body[:2]) - (STAYS if mate.role == TAKES else 0.0), name)
            for name, mate in belief.mates.items()
            if name != self.keeper
        ]
        return (mine, self.briefing.robot) < min(others, default=(math.inf, ""))

    def _take_restart(self, belief: WorldBelief, ball: Point, spot: Point) -> Action:
        """Take a restart of our own toward the middle of the pitch, a kick-off ahead; a penalty at the goal."""
        self._role = TAKES
        target = (0.0, 0.0) if math.hypot(*spot) > STAYS else (_INSET, self._whim.place[1])
        if belief.game.phase is TeamPhase.OUR_PENALTY:
            target = (self.setup.pitch.goal_line, 0.0)
        if not belief.game.running:
            motion = wait_behind(belief.me, spot, target, belief.others, self.setup, self.limits)
            return Action(TAKES, "wait behind the ball", motion)
        if not belief.holding:
            return Action(TAKES, "step in", step_in(belief.me, ball, target, self.setup, self.limits), dribble=True)
        motion, kick = kick_at(belief.me, target, self._whim.speed, ERROR, self.limits)
        return Action(TAKES, "kick", motion, dribble=True, kick=kick)

    def _keep(self, belief: WorldBelief) -> Action:
        """Stand at a drawn place on the goal line, and kick a ball that arrives there away."""
        if belief.holding and belief.game.phase is TeamPhase.PLAY:
            return self._with_ball(belief)._replace(role=KEEPS)
        pitch, reach = self.setup.pitch, self.setup.robot.reach
        widest = 0.5 * pitch.goal_width - reach
        y = widest * self._whim.place[1] / pitch.touch_line
        place = (reach - pitch.goal_line, y)
        spot = belief.ball.now[:2] if belief.ball is not None else (0.0, 0.0)
        if belief.game.phase is not TeamPhase.PLAY and belief.game.spot is not None:
            spot = (belief.game.spot.x, belief.game.spot.y)
        motion = stand(belief.me, place, belief.game, spot, belief.others, self.setup, self.limits)
        return Action(KEEPS, "keep", motion, dribble=belief.game.phase is TeamPhase.PLAY)
