"""Plays mirrored pairs of matches, and reports how balls out, fouls and possession are shared between the colours.

    python benchmarks/check_sides.py --pairs 20 --processes 2
    python benchmarks/check_sides.py --pairs 20 --teams simple simple

The two matches of a pair have the same seed; teams and kick-off are exchanged, so that each team plays as either
colour. Whatever a colour has in excess is therefore the host's and not a team's. Each share is given with an interval
of 95 % from the scatter between the pairs.

Exit status 1 if a share of balls out, fouls or possession is significantly uneven.
It is a check rather than a measurement of speed, and too long for the tests.
"""

import argparse
import math
import multiprocessing
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from schemas.config.match_config import MatchConfig, load_match
from schemas.side import Side
from schemas.soccer.game import EventKind
from sim_host.match.simulation import TickResult
from touchline.play.play_match import play_match

TEAMS = {"simple": "robot_agent.teams.simple:Simple", "nubot": "robot_agent.teams.nubot:NuBot"}
BLAMED = {EventKind.BALL_OUT: "balls out", EventKind.FOUL: "fouls", EventKind.GOAL: "goals"}
"""Kind of event → the row that counts it for the event's side."""
CONTESTED, POSSESSION = "last touches in ticks of both sides", "ticks of possession"
CHECKED = ("balls out", "fouls", POSSESSION)
ROWS = (*BLAMED.values(), CONTESTED, POSSESSION)
SIGNIFICANT = 1.96
"""Standard errors of an interval of 95 %."""

Counts = Counter[tuple[str, Side | None]]
"""Row and colour → number; None for what neither colour is blamed for."""


@dataclass(frozen=True, slots=True)
class Share:
    """Cyan's share of a row in all pairs."""

    cyan: int
    magenta: int
    neither: int
    share: float
    error: float
    """Half of the interval of 95 %."""

    @property
    def is_uneven(self) -> bool:
        """Whether one half lies outside the interval."""
        return abs(self.share - 0.5) > self.error


def match_of(seed: int, teams: Sequence[str], kick_off: Side, options: argparse.Namespace) -> MatchConfig:
    """One match: cyan's team first."""
    content: dict[str, Any] = {
        "seed": seed,
        "rules": options.rules,
        "duration": options.duration,
        "referee": {"kick_off": kick_off.value},
        "teams": {side.value: {"brain": TEAMS[team]} for side, team in zip(Side, teams, strict=True)},
    }
    return load_match(None, content)


def play_pair(options: argparse.Namespace, seed: int) -> Counts:
    """What both matches of a pair blame on each colour."""
    counts: Counts = Counter()

    def count(tick: TickResult) -> None:
        world = tick.world
        for event in tick.events:
            if event.kind in BLAMED:
                counts[BLAMED[event.kind], event.side] += 1
        if world["possession"] is not None:
            counts[POSSESSION, side_of(world["possession"])] += 1
        touches = world.get("touches", ())
        if len({side_of(name) for name in touches}) > 1:
            counts[CONTESTED, None if "level" in world else side_of(touches[-1])] += 1

    for teams, kick_off in ((options.teams, Side.CYAN), (options.teams[::-1], Side.MAGENTA)):
        play_match(match_of(seed, teams, kick_off, options), watch=count)
    return counts


def side_of(robot: str) -> Side:
    """The colour of a robot with a standard name."""
    return Side(robot.rstrip("0123456789"))


def share_of(row: str, pairs: Sequence[Counts]) -> Share:
    """Cyan's share of a row; the error is that of a ratio of sums over independent pairs."""
    cyan = [pair[row, Side.CYAN] for pair in pairs]
    total = [pair[row, Side.CYAN] + pair[row, Side.MAGENTA] for pair in pairs]
    neither = sum(pair[row, None] for pair in pairs)
    if not sum(total) or len(pairs) < 2:
        return Share(sum(cyan), sum(total) - sum(cyan), neither, 0.5, math.inf)
    share = sum(cyan) / sum(total)
    scatter = sum((own - share * both) ** 2 for own, both in zip(cyan, total, strict=True))
    error = math.sqrt(scatter * len(pairs) / (len(pairs) - 1)) / sum(total)
    return Share(sum(cyan), sum(total) - sum(cyan), neither, share, SIGNIFICANT * error)


def main() -> int:
    """Play the pairs and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pairs", type=int, default=20)
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--teams", nargs=2, choices=TEAMS, default=["simple", "nubot"])
    parser.add_argument("--rules", default="msl")
    parser.add_argument("--duration", type=float, default=120.0, help="playing time of a match, s")
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args()
    seeds = range(options.first_seed, options.first_seed + options.pairs)
    with multiprocessing.get_context("spawn").Pool(options.processes) as pool:
        pairs = pool.map(partial(play_pair, options), seeds, chunksize=1)
    print(f"{options.pairs} mirrored pairs, {' – '.join(options.teams)}, rules {options.rules}, {options.duration:g} s")
    print(f"{'':36} {'cyan':>7} {'magenta':>7} {'neither':>7}  cyan's share, 95 %")
    shares = {row: share_of(row, pairs) for row in ROWS}
    for row, one in shares.items():
        print(f"{row:36} {one.cyan:7} {one.magenta:7} {one.neither:7}  {one.share:.3f} ± {one.error:.3f}")
    uneven = [row for row in CHECKED if shares[row].is_uneven]
    if uneven:
        print(f"uneven: {', '.join(uneven)}")
    return 1 if uneven else 0


if __name__ == "__main__":
    sys.exit(main())
