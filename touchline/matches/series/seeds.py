"""Seeds as they are written on a command line: `1-50`, `7`, `1-10,31,40-42`."""

import re
from itertools import pairwise

from schemas.errors import TouchlineError

MAX_SEEDS = 100_000
"""Most seeds of one series; more are a mistake in writing. Chosen here."""
_PART = re.compile(r"(\d{1,18})(?:-(\d{1,18}))?")


def seeds_of(text: str) -> list[int]:
    """The seeds, in the order written.

    Raises:
        TouchlineError: the text is no list of seeds and ranges, or names a seed twice.
    """
    seeds: list[int] = []
    for part in text.replace(" ", "").split(","):
        found = _PART.fullmatch(part)
        if found is None:
            raise TouchlineError(f'--seeds is "{text}"; write a range and single seeds, for example 1-50 or 1-10,31')
        first, last = int(found[1]), int(found[2] or found[1])
        if last < first:
            raise TouchlineError(f'--seeds is "{text}", and {part} ends before it begins; write {last}-{first}')
        if last - first >= MAX_SEEDS - len(seeds):
            raise TouchlineError(f'--seeds is "{text}", which is more than {MAX_SEEDS} seeds; give fewer')
        seeds.extend(range(first, last + 1))
    doubled = next((seed for seed, after in pairwise(sorted(seeds)) if seed == after), None)
    if doubled is not None:
        raise TouchlineError(f'--seeds is "{text}", which has the seed {doubled} twice; equal seeds give equal matches')
    return seeds
