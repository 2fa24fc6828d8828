"""Where the robots of NuBot that do not play the ball are."""

import math

import pytest

from schemas.soccer.game import Point, TeamPhase


@pytest.mark.parametrize("ball", [(8.0, 3.0), (-8.0, -3.0), (0.0, 6.0)])
def test_robots_without_the_ball_follow_it_and_keep_clear_of_it(squad, ball):
    """They stood at home for 60 % of the time."""
    made = squad("nubot")
    for _ in range(300):
        made.move(made.act(ball=ball))
    holds = [name for name, heard in made.said.items() if heard.role == "holds its place"]
    assert len(holds) == 3
    front = [made.poses[name][0] for name in holds if name in ("cyan2", "cyan3")]
    assert all(x == pytest.approx(-2.0 + 0.7 * ball[0], abs=1.5) for x in front)
    assert all(math.dist(made.poses[name][:2], ball) > 2.0 for name in holds)


@pytest.mark.parametrize(
    ("phase", "spot"),
    [
        (TeamPhase.OUR_CORNER, (10.7, 6.7)),
        (TeamPhase.OUR_THROW_IN, (3.0, -6.85)),
        (TeamPhase.OUR_THROW_IN, (-6.0, 6.85)),
    ],
)
def test_a_corner_or_throw_in_finds_a_receiver(squad, phase, spot):
    """Corners went to the opponent 80 of 97 times: all teammates were out of a pass's reach."""
    made, seen = squad("nubot"), {"phase": phase, "spot": Point(x=spot[0], y=spot[1])}
    for _ in range(350):
        made.move(made.act(ball=spot, running=False, **seen))
    taker = min(made.poses, key=lambda name: math.dist(made.poses[name][:2], spot))
    for _ in range(200):
        command = made.act(ball=spot, running=True, holding=True, **seen)[taker]
        x, y, heading = made.poses[taker]
        made.poses[taker] = (x, y, heading + 0.02 * command.drive.omega)
        if command.kick is not None:
            break
    assert command.kick is not None and command.radio.pass_to is not None
    away = math.dist(made.poses[command.radio.pass_to][:2], spot)
    assert 2.0 < away < 9.5
