"""The share of the floor that the robots have been on, in cells of 1 m; 0.95 ends the match."""

from touchline import Moment, Score


def covered(now: Moment) -> Score:
    half_x, half_y = int(now.pitch.length / 2), int(now.pitch.width / 2)
    seen = set(now.memory or [])
    for robot in now.robots.values():
        x, y = int(robot.x + half_x), int(robot.y + half_y)
        if 0 <= x < 2 * half_x and 0 <= y < 2 * half_y:
            seen.add(x * 2 * half_y + y)
    share = len(seen) / (4 * half_x * half_y)
    return Score(share, over=share >= 0.95, memory=sorted(seen))
