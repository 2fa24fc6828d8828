"""The skills as users' code calls them: pure functions from a robot's state and a setpoint to a drive or a kick.

All are in the team frame, in m, rad and s. `me` is `sight.self`; `DriveLimits.of(briefing.setup)` are the limits of the
robot.
"""

from robot_agent.sdk.bodies import Ball, Body, DriveLimits, Moving
from robot_agent.sdk.skills.avoid import circles, free_direction, go_around, is_in_the_way
from robot_agent.sdk.skills.circle import circle
from robot_agent.sdk.skills.go_to import drive, go_to
from robot_agent.sdk.skills.keep_out import keep_out
from robot_agent.sdk.skills.turn_to import turn_to
from robot_agent.soccer.skills.dribble_to import dribble_to
from robot_agent.soccer.skills.intercept import meet, way_of
from robot_agent.soccer.skills.keep_goal import guard_place, keep_goal
from robot_agent.soccer.skills.keep_hold import keep_hold
from robot_agent.soccer.skills.keep_in_play import keep_in_play
from robot_agent.soccer.skills.keep_off import inside, keep_off
from robot_agent.soccer.skills.kick_at import kick_at
from robot_agent.soccer.skills.let_go import let_go
from robot_agent.soccer.skills.line_up import behind, line_up
from robot_agent.soccer.skills.pass_to import best_receiver, is_open, pass_speed, pass_to
from robot_agent.soccer.skills.receive import comes, receive
from robot_agent.soccer.skills.search import search_place
from robot_agent.soccer.skills.shoot import best_place, lane_width
from robot_agent.soccer.skills.take_ball import take_ball
from robot_agent.teams.set_piece import legal_place, stand, step_in, wait_behind

__all__ = [
    "Ball",
    "Body",
    "DriveLimits",
    "Moving",
    "behind",
    "best_place",
    "best_receiver",
    "circle",
    "circles",
    "comes",
    "dribble_to",
    "drive",
    "free_direction",
    "go_around",
    "go_to",
    "guard_place",
    "inside",
    "is_in_the_way",
    "is_open",
    "keep_goal",
    "keep_hold",
    "keep_in_play",
    "keep_off",
    "keep_out",
    "kick_at",
    "lane_width",
    "legal_place",
    "let_go",
    "line_up",
    "meet",
    "pass_speed",
    "pass_to",
    "receive",
    "search_place",
    "stand",
    "step_in",
    "take_ball",
    "turn_to",
    "wait_behind",
    "way_of",
]
