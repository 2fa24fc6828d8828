"""Pursuit: the time until a hunter touches the fox, which is quicker than each of them."""

from pytest import approx

from robot_agent.sdk.contract import Briefing
from support.task_moment import scored, task_config
from touchline.play.play_match import InProcessMatch

PLACES = {"hunter1": (-3.0, 0.0), "hunter2": (0.0, 0.0), "hunter3": (3.0, 3.0), "fox": (3.0, 0.0)}


def test_the_score_falls_with_time_until_a_hunter_touches_the_fox() -> None:
    free = scored("pursuit", PLACES, contacts=[("hunter1", "hunter2")], time=2.0)
    caught = scored("pursuit", PLACES, free.memory, contacts=[("hunter2", "fox")], time=3.0)
    assert (free.value, free.over, caught.value, caught.over) == (-2.0, False, -3.0, True)


def test_a_learner_is_paid_for_coming_nearer() -> None:
    first = scored("pursuit", PLACES, time=1.0)
    nearer = scored("pursuit", PLACES | {"hunter1": (-1.5, 0.0)}, first.memory, time=1.02)
    assert nearer.reward == approx(1.5 / 3 - 0.02)


def test_the_fox_is_quicker_than_a_hunter_that_follows_it() -> None:
    match = InProcessMatch(task_config("pursuit"))
    setup = match.simulation.setup()
    match.close()
    fox, hunter = (Briefing.of(name, setup).setup.drive.max_speed for name in ("fox", "hunter1"))
    assert fox > 1.1 * hunter
