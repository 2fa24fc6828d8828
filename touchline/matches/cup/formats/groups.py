"""Groups: teams are divided by strength, and the first of each group go on to a knock-out."""

from collections.abc import Sequence
from itertools import islice, product
from string import ascii_uppercase

from touchline.matches.cup.formats.knock_out import seeded_places

_ORDERS = 1000
"""Most orders that are tried: of nine tiers of seven teams there are millions."""


def divided(teams: Sequence[str], number: int) -> dict[str, list[str]]:
    """Groups by name, `group A`; places are given forth and back, so that groups are equally strong."""
    groups: dict[str, list[str]] = {f"group {letter}": [] for letter in ascii_uppercase[:number]}
    names = list(groups)
    for place, team in enumerate(teams):
        turn, step = divmod(place, number)
        groups[names[step if turn % 2 == 0 else number - 1 - step]].append(team)
    return groups


def seeded_from(tables: Sequence[Sequence[str]]) -> list[str]:
    """The teams that go on, strongest first: all first of their groups, then all second, and so on.

    `tables` has the teams of each group that go on. The order of each later tier is rotated until no two teams of a
    group meet in the first round, where one of the first thousand orders does that.
    """
    tiers = [list(tier) for tier in zip(*tables, strict=True)]
    group_of = {team: number for number, table in enumerate(tables) for team in table}
    size = len(tables)
    best: list[str] = []
    fewest = size * len(tiers) + 1
    for turns in islice(product(*(range(size) if rank else range(1) for rank in range(len(tiers)))), _ORDERS):
        seeded = [team for tier, turn in zip(tiers, turns, strict=True) for team in tier[turn:] + tier[:turn]]
        again = _meetings_within_a_group(seeded, group_of)
        if again < fewest:
            best, fewest = seeded, again
        if not fewest:
            break
    return best


def _meetings_within_a_group(seeded: Sequence[str], group_of: dict[str, int]) -> int:
    places = seeded_places(len(seeded))
    pairs = zip(places[::2], places[1::2], strict=True)
    return sum(
        one is not None and other is not None and group_of[seeded[one]] == group_of[seeded[other]]
        for one, other in pairs
    )
