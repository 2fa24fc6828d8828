"""The score of pass_and_shoot: a goal counts after a pass, and the reward leads to both."""

from pytest import approx

from schemas.soccer.game import Phase
from support.task_moment import scored


def test_a_goal_counts_after_a_pass_alone() -> None:
    held = scored("pass_and_shoot", touches=("cyan1",))
    direct = scored("pass_and_shoot", memory=held.memory, goals=(1, 0), phase=Phase.STOPPED)
    assert (direct.value, direct.over) == (0.0, True)
    received = scored("pass_and_shoot", memory=held.memory, touches=("cyan2",))
    assert (received.value, received.over) == (0.0, False)
    goal = scored("pass_and_shoot", memory=received.memory, goals=(1, 0), phase=Phase.STOPPED)
    assert (goal.value, goal.over) == (1.0, True)


def test_the_goalkeepers_touch_is_no_pass_and_its_hold_is_the_end() -> None:
    touched = scored("pass_and_shoot", touches=("cyan1", "magenta1"), memory=("cyan1", False, 0.0))
    assert not touched.over and touched.memory[1] is False
    assert scored("pass_and_shoot", holder="magenta1").over


def test_the_reward_grows_with_the_balls_way_to_the_receiver_and_then_to_the_goal() -> None:
    start = scored("pass_and_shoot", ball=(4.0, -2.0), places={"cyan2": (4.0, 2.0)})
    assert start.reward == 0.0
    places = {"cyan2": (4.0, 2.0)}
    nearer = scored("pass_and_shoot", ball=(4.0, 1.0), places=places, memory=start.memory)
    assert nearer.reward == approx(0.15)
    passed = scored("pass_and_shoot", ball=(4.0, 1.7), places=places, memory=nearer.memory, touches=("cyan2",))
    assert passed.reward is not None and passed.reward > 0.1
    shot = scored("pass_and_shoot", ball=(8.0, 0.85), places=places, memory=passed.memory)
    assert shot.reward is not None and shot.reward > 0.15
    goal = scored("pass_and_shoot", ball=(11.1, 0.5), places=places, memory=shot.memory, goals=(1, 0))
    assert goal.reward is not None and goal.reward > 1.0
