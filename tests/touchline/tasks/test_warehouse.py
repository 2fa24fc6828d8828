"""The score of the warehouse: what is fetched and delivered, less the collisions."""

from typing import Any

from sim_host.task.score import Score
from support.task_moment import scored

PICK, ROAD, DROP = (-5.8, 2.1), (0.0, 0.6), (5.9, -2.0)


def moment(place: tuple[float, float], memory: Any, vx: float = 0.0, contacts: Any = ()) -> Score:
    """The score of a moment in which a robot is at this place, with this speed in m/s."""
    return scored("warehouse", {"carrier1": (*place, vx)}, memory, contacts=contacts)


def test_a_robot_that_has_stood_at_both_places_has_delivered_once() -> None:
    memory, values = None, []
    for place in (DROP, PICK, PICK, ROAD, DROP, DROP, ROAD, DROP):
        score = moment(place, memory)
        memory = score.memory
        values.append(score.value)
    assert values == [0, 0, 0, 0, 1, 1, 1, 1]


def test_a_robot_that_drives_through_neither_fetches_nor_delivers() -> None:
    assert moment(DROP, moment(PICK, None, vx=0.5).memory).value == 0
    laden = moment(PICK, None).memory
    assert moment(DROP, laden, vx=0.5).value == 0 and moment(DROP, laden).events == ["carrier1 delivers"]


def test_a_collision_costs_a_delivery_once_for_as_long_as_it_lasts() -> None:
    pair = [("carrier1", "carrier2")]
    first = moment(ROAD, None, contacts=pair)
    lasting = moment(ROAD, first.memory, contacts=pair)
    apart = moment(ROAD, lasting.memory)
    again = moment(ROAD, apart.memory, contacts=pair)
    assert [one.value for one in (first, lasting, apart, again)] == [-1, -1, -1, -2]
    assert first.events == ["carrier1 and carrier2 collide"]
