"""Match quality over delay, loss and cuts: ten agents on two machines and their host on a third, in namespaces.

    .venv/bin/python benchmarks/bench_network.py --seconds 60

Every row is a match in real time of the same seed. The first is undisturbed; the others are compared with it.
"""

import argparse
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from support.link_emulator import LinkConditions
from support.machines import machines
from support.namespaces import why_not
from support.process_story import Listener

BRAINS = {"cyan": "robot_agent.teams.simple:Simple", "magenta": "robot_agent.teams.nubot:NuBot"}
ROBOTS = {side: [f"{side}{number}" for number in range(1, 6)] for side in BRAINS}
WARM_UP = 100
"""Ticks before the link is disturbed."""
EVERY = 500
"""Ticks between two cuts."""


class Row(NamedTuple):
    """One line of the table."""

    name: str
    conditions: LinkConditions
    cut_ticks: int = 0
    """Length of each cut; 0 without cuts."""


ROWS = [
    Row("undisturbed", LinkConditions()),
    *(Row(f"delay {delay} ms", LinkConditions(delay_ms=delay)) for delay in (10, 20, 40, 60, 80, 100)),
    Row("delay 20 ± 10 ms", LinkConditions(delay_ms=20.0, jitter_ms=10.0)),
    *(Row(f"loss {loss} %", LinkConditions(delay_ms=2.0, loss=loss / 100.0)) for loss in (1, 5, 10, 20)),
    Row("cuts of 1 s", LinkConditions(), 50),
    Row("cuts of 3 s", LinkConditions(), 150),
]


class Quality(NamedTuple):
    """The figures of one match."""

    late_ticks: int
    missed: float
    """Share of the ticks in which a robot has no new command."""
    braked: float
    """Share of the ticks in which the watchdog lets a robot stand."""
    latency_ms: float
    score: str


def measure(row: Row, seconds: float, seed: int) -> Quality:
    """Play one match, with the links of both teams as in the row."""
    overrides = {f"teams.{side}.robots": names for side, names in ROBOTS.items()}
    overrides |= {"referee.mode": "automatic", "seed": seed}
    with (
        tempfile.TemporaryDirectory() as folder,
        machines(("host", "cyan", "magenta"), Path(folder), **overrides) as field,
    ):
        field.start_host()
        log = field.listen()
        for side, names in ROBOTS.items():
            for robot in names:
                field.start_agent(robot, side, brain=BRAINS[side])
        log.until(lambda one: one.healths and all(robot.answers for robot in one.healths[-1].robots.values()), "robots")
        log.for_ticks(WARM_UP)

        def impair(conditions: LinkConditions) -> None:
            for side in ROBOTS:
                field.net.impair(side, conditions)

        if row.conditions != LinkConditions() or row.cut_ticks:
            impair(row.conditions)
        log.for_ticks(WARM_UP)
        begin, before = len(log.applied), log.healths[-1]
        last = log.tick + round(seconds * 50)
        while row.cut_ticks and log.tick + EVERY <= last:
            impair(LinkConditions(is_cut=True))
            log.for_ticks(row.cut_ticks)
            impair(row.conditions)
            log.for_ticks(EVERY - row.cut_ticks)
        log.until_tick(last)
        return _quality(log, begin, before.late_ticks)


def _quality(log: Listener, begin: int, late_before: int) -> Quality:
    missed = braked = count = 0
    for applied in log.applied[begin:]:
        for command in applied.inputs.values():
            count += 1
            if command.answers_tick is None:
                missed += 1
                drive = command.drive
                braked += not (drive.vx or drive.vy or drive.omega or command.dribble)
    latencies = sorted(robot.latency_ms or 0.0 for robot in log.healths[-1].robots.values())
    score = log.logs["game/state"][-1].score
    late = log.healths[-1].late_ticks - late_before
    return Quality(
        late, missed / count, braked / count, latencies[len(latencies) // 2], f"{score.cyan}:{score.magenta}"
    )


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20.0, help="length of each match")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rows", default="", help="only rows whose names contain this")
    arguments = parser.parse_args()
    reason = why_not()
    if reason is not None:
        sys.stderr.write(f"bench_network is skipped: {reason}\n")
        return 0
    print("| link, each way | late ticks of the host | ticks without a command | robots stand | latency | score |")
    print("| --- | --- | --- | --- | --- | --- |")
    for row in ROWS:
        if arguments.rows in row.name:
            late, missed, braked, latency, score = measure(row, arguments.seconds, arguments.seed)
            print(
                f"| {row.name} | {late} | {missed:.1%} | {braked:.1%} | {latency:.0f} ms | {score} |".replace(
                    "%", " %"
                ),
                flush=True,
            )
    return 0


if __name__ == "__main__":
    sys.exit(main())
