"""The score of formation: the way of the middle, counted while all robots are in their places."""

from pytest import approx

from support.task_moment import scored
from touchline.tasks.formation import PLACES, WITHIN

NAMES = ("one", "two", "three", "four", "five")


def at(x: float, y: float, off: float = 0.0) -> dict[str, tuple[float, float]]:
    """The wedge around (x, y), with its second robot `off` m away from its place."""
    places = {name: (x + px, y + py) for name, (px, py) in zip(NAMES, PLACES, strict=True)}
    return places | {"two": (places["two"][0] + off, places["two"][1])}


def test_the_way_toward_the_corner_counts_once() -> None:
    first = scored("formation", at(2.8, -1.5))
    on = scored("formation", at(2.8, -0.5), first.memory)
    back = scored("formation", at(2.8, -1.5), on.memory)
    again = scored("formation", at(2.8, -0.3), back.memory)
    assert (first.value, on.value, back.value, again.value) == (0.0, approx(1.0), approx(1.0), approx(1.2))


def test_the_way_of_robots_out_of_their_places_is_lost() -> None:
    first = scored("formation", at(2.8, -1.5))
    loose = scored("formation", at(2.8, -0.5, off=1.5 * WITHIN), first.memory)
    again = scored("formation", at(2.8, -0.1), loose.memory)
    assert loose.value == 0.0 and 0.3 < again.value < 0.5


def test_after_a_corner_comes_the_next_and_after_the_last_the_first() -> None:
    memory, total = None, 0.0
    for x, y in ((2.8, -1.5), (2.8, 1.5), (-2.8, 1.5), (-2.8, -1.5), (2.8, -1.5), (2.8, 1.5)):
        score = scored("formation", at(x, y), memory)
        memory, total = score.memory, score.value
    assert total == approx(3.0 + 5.6 + 3.0 + 5.6 + 3.0)
