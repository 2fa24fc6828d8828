"""Distance and speed, on ways made by hand."""

from pytest import approx

from schemas.game import Phase
from schemas.roster import RosterEntry
from schemas.side import Side


def drive(film, robot: str, step: tuple[float, float], ticks: int, **said) -> None:
    for _ in range(ticks):
        x, y = film.places[robot]
        film.places[robot] = (x + step[0], y + step[1])
        film.shot(moving={robot: (step[0] * 10, step[1] * 10)}, **said)


def of(film, robot: str):
    return next(one for one in film.figures().robots if one.name == robot)


def test_distance_is_the_length_of_the_path_and_mean_speed_is_over_the_time_in_play(film) -> None:
    drive(film, "cyan2", (0.3, 0.4), 4)  # 5 m/s for 0.4 s
    film.rest(6)
    film.shot(phase=Phase.STOPPED, running=False)
    drive(film, "cyan2", (0.0, -0.1), 10)
    robot = of(film, "cyan2")
    assert robot.distance == approx(2.0 + 1.0)
    assert robot.in_play_distance == approx(2.0)
    assert robot.mean_speed == approx(2.0 / 1.1)
    assert robot.top_speed == approx(5.0)
    assert film.figures().sides[Side.CYAN].distance == approx(3.0)


def test_a_robot_that_is_set_down_has_driven_nothing(film) -> None:
    film.places["cyan2"] = (-2.5, 3.0)
    film.shot(placed=["cyan2"])
    film.places["magenta2"] = (9.0, 5.0)
    film.shot()  # farther in a tick than any robot drives
    assert of(film, "cyan2").distance == of(film, "magenta2").distance == 0.0


def test_another_episode_begins_without_a_way_to_it(film) -> None:
    film.episode = 2
    film.places["cyan2"] = (-2.1, 3.0)
    film.shot()
    assert of(film, "cyan2").distance == 0.0


def test_a_robot_off_the_field_is_not_measured(film) -> None:
    drive(film, "cyan2", (0.1, 0.0), 5)
    drive(film, "cyan2", (0.3, 0.0), 5, off=["cyan2"])
    drive(film, "cyan2", (0.1, 0.0), 5)
    robot = of(film, "cyan2")
    assert robot.distance == approx(0.5 + 0.4)  # its first step is that in which it comes back
    assert robot.top_speed == approx(1.0)


def test_a_robot_that_comes_later_is_measured_from_then_on_and_known_by_its_side(film) -> None:
    film.rest()
    film.places["joker"] = (0.0, 5.0)
    roster = [RosterEntry(name=name, side=Side("cyan" if name[0] == "c" else "magenta")) for name in film.places]
    film.shot(roster=roster)
    drive(film, "joker", (0.1, 0.0), 5)
    assert (of(film, "joker").side, of(film, "joker").distance) == ("magenta", approx(0.5))


def test_missing_ticks_are_bridged(film) -> None:
    drive(film, "cyan2", (0.2, 0.0), 10)
    lost = [round(tick * 0.1 * 1e9) for tick in (4, 5, 6)]
    film.messages = [(time, message) for time, message in film.messages if time not in lost]
    assert of(film, "cyan2").distance == approx(2.0)
    assert film.figures().in_play_s == approx(1.0)
