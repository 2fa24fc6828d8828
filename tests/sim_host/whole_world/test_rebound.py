"""A ball that flies against what stands: rebounds as the coefficients say, wherever in a step it arrives."""

import math

import pytest
from pytest import approx

from schemas.host import Placement
from schemas.profile import load_profile
from schemas.robot_model import RobotModel
from schemas.side import Side
from sim_host.snapshot import Roster
from sim_host.world.engine import Engine

PROFILE = load_profile("msl")
ROSTER = Roster(("cyan1",), (Side.CYAN,), {Side.CYAN: "cyan1"}, (RobotModel.standard(PROFILE),))
FIELD, BALL, ROBOT = PROFILE.field, PROFILE.ball, PROFILE.robot
AT_GOAL = FIELD.goal_width / 2 + FIELD.post / 2
KEPT = {"boundary": 0.5 * BALL.restitution, "post": BALL.restitution, "robot": ROBOT.restitution}
"""Share of the normal speed that is kept."""
FACES = {
    "boundary": (FIELD.goal_line + FIELD.border, 4.0),
    "post": (FIELD.goal_line, AT_GOAL),
    "robot": (5.0 - ROBOT.radius, 0.0),
}
"""x of the face, and y, m."""


@pytest.mark.parametrize("phase", [0.0, 0.2, 0.4, 0.6, 0.8])
@pytest.mark.parametrize("speed", [3.0, 10.0, 20.0])
@pytest.mark.parametrize("face", KEPT)
def test_the_rebound_is_the_restitution_in_whatever_phase_of_a_step_it_comes(
    face: str, speed: float, phase: float
) -> None:
    """Newton's e of the profile within 0.01, and never deeper than 5 mm; of a robot, which yields, less its recoil.

    A robot of mass M is left by a ball of mass m with e - (1 + e)·m / (m + M) of its speed. Without being brought to
    the touch the ball kept up to 0.07 more, by how deep it happened to be when the engine noticed.
    """
    kept, (x, y) = KEPT[face], FACES[face]
    if face == "robot":
        kept -= (1 + kept) * BALL.mass / (BALL.mass + ROBOT.mass)
    engine = Engine(PROFILE, ROSTER)
    engine.place(Placement(body="cyan1", x=5.0, y=0.0))
    step = PROFILE.time.physics_step
    engine.set_ball(
        (x - BALL.radius - (5 + phase) * speed * step, y, ROBOT.height / 2), (speed, 0.0, 0.0), (0.0, 0.0, 0.0)
    )
    deepest = 0.0
    for _ in range(8):
        engine.drive([(0.0, 0.0, 0.0)])
        engine.bring_ball()
        engine.step()
        deepest = max(deepest, engine.ball_contacts(None).depth)
    (_, _, _), _, (vx, vy, _), _ = engine.ball_now()
    assert -vx / speed == approx(kept, abs=0.01)
    assert math.isclose(vy, 0.0, abs_tol=0.01 * speed)
    assert deepest < 0.005
    engine.close()
