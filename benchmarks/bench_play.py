"""How the shipped teams play: the ladder, and the reference team against the sparring teams, itself, and a poor radio.

    python benchmarks/bench_play.py --matches 40 --duration 600
    python benchmarks/bench_play.py --pairings reference-simple self-play --matches 4 --duration 120

A match of 600 s is 2 × 5 minutes, by the rules `msl` with default noise. Each seed is played twice, with sides
swapped, unless a team plays against itself.
The engine is that of `touchline series`. It prints tables for benchmarks/results/play.md.
"""

import argparse
import itertools
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from schemas.config.match_config import load_match
from schemas.config.shipped_teams import brain_of
from touchline.matches.engine.play_list import play_list
from touchline.matches.series.match_row import FailedMatch, MatchRow, rows_of
from touchline.matches.series.plan import SeriesPlan, plan_series
from touchline.matches.series.summary import summary_of
from touchline.matches.series.table import figure_rows, longest_line

LADDER = ("reference", "simple", "nubot", "random")
"""From the strongest team to the weakest."""
SPARRING = {"early": "sparring.early:Early", "press": "sparring.press:Press", "deep": "sparring.deep:Deep"}
"""Teams of other styles, against which `reference` is tuned, too: brains in `examples/sparring`."""
EXAMPLES = Path(__file__).parents[1] / "examples"
WITHOUT_RADIO = "robot_agent.teams.reference:WithoutRadio"
POOR_RADIO = {"loss": 0.2, "delay": 0.1}
"""Share of messages lost; s of delay."""
RULES = "msl"


@dataclass(frozen=True, slots=True)
class Pairing:
    """Two teams, and the settings of their matches."""

    first: str
    second: str
    settings: dict[str, Any] = field(default_factory=dict)

    @property
    def both_sides(self) -> bool:
        """Whether a seed is played twice, with sides swapped: of a team against itself that is the same match."""
        return self.first != self.second


PAIRINGS = {f"{first}-{second}": Pairing(first, second) for first, second in itertools.combinations(LADDER, 2)} | {
    **{f"reference-{name}": Pairing("reference", brain) for name, brain in SPARRING.items()},
    "self-play": Pairing("reference", "reference"),
    "poor-radio": Pairing("reference", "simple", {"radio": POOR_RADIO}),
    "without-radio": Pairing("reference", WITHOUT_RADIO),
}


def plan_of(pairing: Pairing, options: argparse.Namespace) -> SeriesPlan:
    """As many seeds as matches, or half as many where each is played on both sides."""
    brains = {"cyan": pairing.first, "magenta": pairing.second}
    teams = {side: {"name": team, "brain": brain_of(team)} for side, team in brains.items()}
    config = load_match(None, {"rules": RULES, "duration": options.duration, "teams": teams, **pairing.settings})
    count = options.matches // 2 if pairing.both_sides else options.matches
    seeds = range(options.first_seed, options.first_seed + count)
    return plan_series(config, seeds, both_sides=pairing.both_sides, brain_folder=EXAMPLES)


def tables_of(name: str, pairing: Pairing, rows: list[MatchRow]) -> str:
    """Markdown: the figures of both teams, then those of the match."""
    summary = summary_of(rows)
    lines = [f"| {name}, {len(rows)} matches | {pairing.first} | {pairing.second} |", "| --- | --- | --- |"]
    lines += [f"| {' | '.join(cells)} |" for cells in figure_rows(summary.teams)]
    lines += ["", f"| {name} | match |", "| --- | --- |"]
    lines += [f"| {' | '.join(cells)} |" for cells in figure_rows(summary.match)]
    return "\n".join([*lines, "", *map(longest_line, summary.longest), ""])


def main() -> int:
    """Play the pairings and print the tables. Returns 1 if a match failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pairings", nargs="+", choices=PAIRINGS, default=list(PAIRINGS), help="default: all")
    parser.add_argument("--matches", type=int, default=40, help="of a pairing, half on each side")
    parser.add_argument("--duration", type=float, default=600.0, help="playing time of a match, s")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=0, help="matches at a time; 0 for one per core")
    options = parser.parse_args()
    if options.matches < 2 or options.matches % 2:
        parser.error(f"--matches is {options.matches}; give an even number, as each seed is played on both sides")
    failures: list[FailedMatch] = []
    played = f"{options.matches} matches of {options.duration:g} s a pairing, sides swapped"
    print(f"{played}, rules {RULES}, default noise; in brackets: intervals of 95 %\n", flush=True)
    for name in options.pairings:
        plan = plan_of(PAIRINGS[name], options)
        played = play_list(
            [one.planned for one in plan.matches], options.jobs, name, lambda one, _: one.label, json=False
        )
        ended = rows_of(plan, played.outcomes)
        rows = [row for row in ended if isinstance(row, MatchRow)]
        for row in ended:
            if isinstance(row, FailedMatch):
                failures.append(row)
                print(f"{name}, seed {row.seed}: {row.reason}", file=sys.stderr)
        if rows:
            print(tables_of(name, PAIRINGS[name], rows), flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
