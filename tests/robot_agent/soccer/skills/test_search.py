import math

from robot_agent.soccer.skills.search import STAYS, search_place


def test_four_robots_together_see_the_whole_pitch_and_each_of_them_comes_around(setup):
    pitch = setup.pitch
    places = [search_place(number, 0.0, pitch) for number in (2, 3, 4, 5)]
    for x in range(-11, 12):
        for y in range(-7, 8):
            assert min(math.dist((x, y), place) for place in places) < 7.0
    one = {search_place(2, STAYS * step, pitch) for step in range(4)}
    assert one == set(places)
    assert search_place(2, 0.0, pitch) == search_place(2, 0.9 * STAYS, pitch)
