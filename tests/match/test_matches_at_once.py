"""Several matches that start in the same second on one machine, and agents that come to a match that is not theirs."""

import json

import pytest

from recordings.reading.recording import open_recording
from schemas.topics import APPLIED

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

MATCH = "[teams.cyan]\nsize = 2\n[teams.magenta]\nsize = 2\n"
SEEDS = (1, 1, 2)


def outcome(program, folder):
    """What a match was, without its speed."""
    assert program.status() == 0, program.err
    result = json.loads(program.out)
    assert result["losses"] == {}
    applied = [recorded.message() for recorded in open_recording(folder / result["recording"]).messages(APPLIED.key)]
    return result["score"], result["events"], applied[-1].tick, applied[-1].chain


def test_matches_that_start_in_the_same_second_are_the_matches_of_their_seeds_alone(start, folder):
    (folder / "small.toml").write_text(MATCH)

    def begin(seed, name):
        arguments = ("touchline", "match", "small.toml", "--duration", "2", "--seed", str(seed), "--json")
        return start(*arguments, folder=folder, name=name)

    together = [begin(seed, f"together{number}") for number, seed in enumerate(SEEDS)]
    outcomes = [outcome(program, folder) for program in together]
    alone = {seed: outcome(begin(seed, f"alone{seed}"), folder) for seed in set(SEEDS)}
    assert alone[1] != alone[2]
    assert outcomes == [alone[seed] for seed in SEEDS]
