"""The start of a drill."""

from pytest import approx

from schemas.config.scene import load_scene
from schemas.config.soccer.drill import Variation
from sim_host.staging.variation import varied

SCENE = load_scene("one_against_keeper").model_copy(
    update={"vary": [Variation(body="ball", x=0.5, vy=1.0), Variation(body="cyan2", heading=0.2)]}
)


def test_equal_seeds_give_equal_starts_and_others_give_others() -> None:
    assert varied(SCENE, 3) == varied(SCENE, 3)
    assert len({varied(SCENE, seed).ball.x for seed in range(20)}) == 20


def test_starts_are_within_the_given_distance_on_both_sides() -> None:
    starts = [varied(SCENE, seed) for seed in range(200)]
    for shifts, width in (
        ([start.ball.x - SCENE.ball.x for start in starts], 0.5),
        ([start.ball.vy for start in starts], 1.0),
        ([start.robots[0].heading - SCENE.robots[0].heading for start in starts], 0.2),
    ):
        assert all(abs(shift) <= width for shift in shifts)
        assert min(shifts) < -0.8 * width and max(shifts) > 0.8 * width
        assert sum(shifts) / len(shifts) == approx(0.0, abs=0.2 * width)


def test_what_does_not_vary_stays() -> None:
    start = varied(SCENE, 7)
    assert (start.ball.y, start.ball.vx, start.robots[1]) == (SCENE.ball.y, SCENE.ball.vx, SCENE.robots[1])
