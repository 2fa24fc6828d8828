"""What a robot uses, against its limits."""

import pytest

from schemas.config.confinement import Limits
from touchline.launch.process_tree import Usage
from touchline.launch.usage_watch import UsageWatch, exceeded

LIMITS = Limits(memory=2.0, processes=64, cpu_time=60.0)


@pytest.mark.parametrize(
    ("usage", "limit", "sentence"),
    [
        (Usage(2_000_000_000, 64, 60.0), None, ""),
        (
            Usage(2_000_000_001, 64, 60.0),
            "memory",
            "it used more than 2 GB of memory; raise [limits] memory, or --memory of touchline team",
        ),
        (
            Usage(1, 65, 0.0),
            "processes",
            "it had more than 64 processes and threads; raise [limits] processes, or --processes of touchline team",
        ),
        (
            Usage(1, 1, 60.1),
            "cpu_time",
            "it used more than 60 s of CPU time; raise [limits] cpu_time, or --cpu-time of touchline team",
        ),
    ],
)
def test_a_robot_may_use_its_limits_and_no_more(usage: Usage, limit: str | None, sentence: str) -> None:
    assert exceeded(usage, LIMITS) == limit
    assert limit is None or LIMITS.breach(limit) == sentence


class Watched:
    """A robot with a process id that no process has."""

    pid = 2**30

    def __init__(self, ended: int | None = None) -> None:
        self._ended = ended
        self.ended_for: list[str] = []

    def status(self) -> int | None:
        return self._ended

    def end_for(self, limit: str) -> None:
        self.ended_for.append(limit)


def test_a_robot_within_its_limits_and_one_that_has_ended_are_left_alone() -> None:
    robots = {"cyan1": Watched(), "cyan2": Watched(ended=0)}
    UsageWatch().check({name: (robot, LIMITS) for name, robot in robots.items()})
    assert [robot.ended_for for robot in robots.values()] == [[], []]


def test_a_process_without_robots_has_nothing_left_behind() -> None:
    watch = UsageWatch()
    watch.add_own()
    assert watch.end_left_behind() == {}
