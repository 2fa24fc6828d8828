"""Coverage: the share of a floor that robots with range finders have been on. A rover to start from, without a map."""

import math

from touchline import Briefing, Command, Drive, Moment, RangeReading, Score, Sight

CELL = 0.5
"""m; edge of a cell of the floor, about the width of a robot."""
ROOM = 0.25
"""m from an obstacle within which a robot's centre cannot be."""
NEAR = 0.8
"""m from the middle of a robot, where it begins to turn away from what a beam meets ahead."""


def covered(now: Moment) -> Score:
    """The share of the cells that a robot's centre has been in, of those that no obstacle takes up; all end it."""
    rows, columns = int(now.pitch.width / CELL), int(now.pitch.length / CELL)
    seen, free = now.memory or (0, free_cells(now, rows, columns))
    for robot in now.robots.values():
        column = math.floor((robot.x + now.pitch.goal_line) / CELL)
        row = math.floor((robot.y + now.pitch.touch_line) / CELL)
        if 0 <= column < columns and 0 <= row < rows:
            seen |= 1 << (row * columns + column)
    left = (free & ~seen).bit_count()
    return Score(1.0 - left / free.bit_count(), over=left == 0, memory=(seen, free))


def free_cells(now: Moment, rows: int, columns: int) -> int:
    """A number with a bit for each cell, row by row, which is set where a robot has room."""
    free = 0
    for cell in range(rows * columns):
        x = (cell % columns + 0.5) * CELL - now.pitch.goal_line
        y = (cell // columns + 0.5) * CELL - now.pitch.touch_line
        free |= has_room(now, x, y) << cell
    return free


def has_room(now: Moment, x: float, y: float) -> bool:
    """Whether a robot at (x, y), m, is clear of all obstacles; boxes are widened by its size with their corners."""
    for body in now.obstacles.values():
        away, angle = math.hypot(x - body.x, y - body.y), math.atan2(y - body.y, x - body.x) - body.heading
        along, across = away * abs(math.cos(angle)), away * abs(math.sin(angle))
        if body.is_round:
            is_clear = away > body.radius + ROOM
        else:
            is_clear = along > body.size_x / 2 + ROOM or across > body.size_y / 2 + ROOM
        if not is_clear:
            return False
    return True


class Rover:
    """Drives straight on, and turns away from what is ahead of it until the way is free."""

    def __init__(self, briefing: Briefing) -> None:
        self.top = briefing.setup.drive.max_speed
        self.turn = 0.0
        """Direction in which it is turning: 1 to the left, -1 to the right, 0 straight on."""

    def act(self, sight: Sight) -> Command:
        """The command for one sight."""
        scan = sight.sensors["scan"]
        assert isinstance(scan, RangeReading)
        far = [math.inf if distance is None else distance for distance in scan.distances]
        beams = {scan.angle_min + number * scan.angle_increment: distance for number, distance in enumerate(far)}
        ahead = min(distance for angle, distance in beams.items() if abs(angle) < 0.9)
        if ahead > NEAR:
            self.turn = 0.0
        elif not self.turn:
            left = min(distance for angle, distance in beams.items() if 0.0 < angle < 1.6)
            right = min(distance for angle, distance in beams.items() if -1.6 < angle < 0.0)
            self.turn = 1.0 if left > right else -1.0
        drive = Drive(omega=2.5 * self.turn) if self.turn else Drive(vx=min(self.top, ahead))
        return Command(answers_tick=sight.tick, drive=drive)
