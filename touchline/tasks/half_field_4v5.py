"""Four attackers in the half of five defenders: a goal, or none. Its score; its baseline is the team `reference`."""

import math

from touchline import Moment, Score

NEARER = 0.02
"""Reward for each metre that the ball comes nearer to the goal."""
HELD = 3.0
"""s for which a defender holds the ball until the attack is over."""


def scored(now: Moment) -> Score:
    """1 for a goal, otherwise 0; over with any goal, and when the ball leaves the half or the defenders have won it.

    They have won it when they hold it for a while or get a restart; a restart of the attackers is part of the attack. A
    goal is too rare for a learner that begins with random actions, so that its reward has the ball's way, too.
    """
    assert now.ball is not None
    away = math.dist(now.ball[:2], (now.pitch.goal_line, 0.0))
    before, free = now.memory or (away, now.time)
    in_play = now.game.phase == "play"
    if not in_play or now.holder is None or now.sides[now.holder] == "cyan":
        free = now.time
    goals = float(now.game.score.cyan)
    is_won = now.time - free > HELD or now.game.side == "magenta" or now.game.score.magenta > 0
    is_left = in_play and not now.zones["half"].contains(*now.ball[:2])
    reward = goals + NEARER * (before - away)
    return Score(goals, over=goals > 0.0 or is_won or is_left, reward=reward, memory=(away, free))
