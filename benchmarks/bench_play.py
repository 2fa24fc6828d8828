"""The ladder: each team against the next weaker ones, the same seeds with sides swapped, as a table for docs/play.md.

    python benchmarks/bench_play.py --matches 40 --duration 600
    python benchmarks/bench_play.py --teams simple nubot --matches 4 --duration 120

A match of 600 s is 2 × 5 minutes, by the rules `msl` with the default noise and radio. The engine is that of
`touchline series`, which prints more figures of one pairing.
"""

import argparse
import itertools
import sys

from schemas.config.match_config import load_match
from touchline.scheduling.child_processes import cores
from touchline.series.match_row import FailedMatch, MatchRow, Row
from touchline.series.plan import SeriesPlan, plan_series
from touchline.series.play_series import play_series
from touchline.series.summary import summary_of
from touchline.series.table import figure_rows
from touchline.series.team_names import brain_of, shipped_teams

LADDER = ("reference", "simple", "nubot", "random")
"""From the strongest team to the weakest."""
RULES = "msl"
ROWS = {
    "share of points, draws half": "points",
    "goals in ten minutes": "goals in 10 min",
    "passes completed a minute": "passes a min",
    "passes completed": "completed",
    "m of a field robot in ten minutes": "m a field robot in 10 min",
    "fouls a minute": "fouls a min",
}
"""Figure of a series → its column."""


def plan_of(first: str, second: str, options: argparse.Namespace) -> SeriesPlan:
    """Half as many seeds as matches: each is played on both sides."""
    teams = {side: {"name": team, "brain": brain_of(team)} for side, team in (("cyan", first), ("magenta", second))}
    config = load_match(None, {"rules": RULES, "duration": options.duration, "teams": teams})
    seeds = range(options.first_seed, options.first_seed + options.matches // 2)
    return plan_series(config, seeds, both_sides=True)


def lines_of(plan: SeriesPlan, rows: list[MatchRow]) -> list[str]:
    """Two lines of a Markdown table: one for each team of a pairing."""
    cells = {name: values for name, *values in figure_rows(summary_of(rows).teams)}
    lines = []
    for which, team in enumerate(plan.teams):
        results = "–".join(cells[name][which] for name in ("won", "drawn", "lost"))
        columns = [cells[name][which] for name in ROWS]
        lines.append(f"| {team} | {plan.teams[1 - which]} | {len(rows)} | {results} | {' | '.join(columns)} |")
    return lines


def main() -> int:
    """Play the pairings and print the table. Returns 1 if a match failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--teams", nargs="+", choices=shipped_teams(), help="strongest first; default: the ladder")
    parser.add_argument("--matches", type=int, default=40, help="of a pairing, half on each side")
    parser.add_argument("--duration", type=float, default=600.0, help="playing time of a match, s")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=0, help="matches at a time; 0 for one per core")
    options = parser.parse_args()
    if options.matches < 2 or options.matches % 2:
        parser.error(f"--matches is {options.matches}; give an even number, as each seed is played on both sides")
    teams = options.teams or [team for team in LADDER if team in shipped_teams()]
    if len(teams) < 2:
        parser.error(f"--teams is {' '.join(teams)}; name at least two")
    failures: list[FailedMatch] = []
    columns = ["team", "against", "matches", "won–drawn–lost", *ROWS.values()]
    print(f"| {' | '.join(columns)} |\n|{' --- |' * len(columns)}")
    for first, second in itertools.combinations(teams, 2):
        plan, ended = plan_of(first, second, options), list[Row]()
        play_series(plan, options.jobs or cores(), ended.append)
        rows = [row for row in ended if isinstance(row, MatchRow)]
        for row in ended:
            if isinstance(row, FailedMatch):
                failures.append(row)
                print(f"{first} – {second}, seed {row.seed}: {row.reason}", file=sys.stderr)
        if rows:
            print("\n".join(lines_of(plan, rows)), flush=True)
    played = f"{options.matches} matches of {options.duration:g} s a pairing, sides swapped"
    print(f"\n{played}, rules {RULES}, default noise and radio; in brackets: intervals of 95 %")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
