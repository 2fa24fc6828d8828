"""Distance and speed, on ways made by hand."""

from pytest import approx

from schemas.config.roster import RosterEntry
from schemas.side import Side
from schemas.soccer.game import Phase


def drive(script, robot: str, step: tuple[float, float], ticks: int, **said) -> None:
    for _ in range(ticks):
        x, y = script.places[robot]
        script.places[robot] = (x + step[0], y + step[1])
        script.shot(moving={robot: (step[0] * 10, step[1] * 10)}, **said)


def of(script, robot: str):
    return next(one for one in script.figures().robots if one.name == robot)


def test_distance_is_the_length_of_the_path_and_mean_speed_is_over_the_time_in_play(script) -> None:
    drive(script, "cyan2", (0.3, 0.4), 4)  # 5 m/s for 0.4 s
    script.rest(6)
    script.shot(phase=Phase.STOPPED, running=False)
    drive(script, "cyan2", (0.0, -0.1), 10)
    robot = of(script, "cyan2")
    assert robot.distance == approx(2.0 + 1.0)
    assert robot.in_play_distance == approx(2.0)
    assert robot.mean_speed == approx(2.0 / 1.1)
    assert robot.top_speed == approx(5.0)
    assert script.figures().sides[Side.CYAN].distance == approx(3.0)


def test_a_robot_that_is_set_down_has_driven_nothing(script) -> None:
    script.places["cyan2"] = (-2.5, 3.0)
    script.shot(placed=["cyan2"])
    script.places["magenta2"] = (9.0, 5.0)
    script.shot()  # farther in a tick than any robot drives
    assert of(script, "cyan2").distance == of(script, "magenta2").distance == 0.0


def test_another_episode_begins_without_a_way_to_it(script) -> None:
    script.episode = 2
    script.places["cyan2"] = (-2.1, 3.0)
    script.shot()
    assert of(script, "cyan2").distance == 0.0


def test_a_robot_off_the_field_is_not_measured(script) -> None:
    drive(script, "cyan2", (0.1, 0.0), 5)
    drive(script, "cyan2", (0.3, 0.0), 5, off=["cyan2"])
    drive(script, "cyan2", (0.1, 0.0), 5)
    robot = of(script, "cyan2")
    assert robot.distance == approx(0.5 + 0.4)  # its first step is that in which it comes back
    assert robot.top_speed == approx(1.0)


def test_a_robot_that_comes_later_is_measured_from_then_on_and_known_by_its_side(script) -> None:
    script.rest()
    script.places["joker"] = (0.0, 5.0)
    roster = [RosterEntry(name=name, side=Side("cyan" if name[0] == "c" else "magenta")) for name in script.places]
    script.shot(roster=roster)
    drive(script, "joker", (0.1, 0.0), 5)
    assert (of(script, "joker").side, of(script, "joker").distance) == ("magenta", approx(0.5))


def test_missing_ticks_are_bridged(script) -> None:
    drive(script, "cyan2", (0.2, 0.0), 10)
    lost = [round(tick * 0.1 * 1e9) for tick in (4, 5, 6)]
    script.messages = [(time, message) for time, message in script.messages if time not in lost]
    assert of(script, "cyan2").distance == approx(2.0)
    assert script.figures().in_play_s == approx(1.0)


def test_a_side_without_robots_has_a_top_speed_of_zero(script) -> None:
    script.messages.clear()
    for name in ("magenta1", "magenta2"):
        del script.places[name]
    script.shot(moving={"cyan2": (2.0, 0.0)}, **script.game)
    figures = script.figures()
    assert figures.sides[Side.CYAN].top_speed == approx(2.0)
    assert figures.sides[Side.MAGENTA].top_speed == 0.0
