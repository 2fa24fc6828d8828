"""A short match of one robot a side, and a folder with brains."""

from pathlib import Path

import pytest

from support.brisk import BRISK

BRAINS = '''"""Brains for tests of series."""

from touchline import Command, Drive

built = 0


class Still:
    def __init__(self, briefing):
        global built
        built += 1
        self.briefing = briefing

    def act(self, sight):
        return Command(answers_tick=sight.tick)


class Forward(Still):
    def act(self, sight):
        print("on stdout")
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0), dribble=True)


class RaisesInMagenta(Still):
    def act(self, sight):
        if self.briefing.side == "magenta" and sight.tick == 20:
            raise ValueError("no idea")
        return super().act(sight)


class OnceOnly(Still):
    """Raises in a process that has played a match before."""

    def act(self, sight):
        assert built == 2  # one for each side
        return super().act(sight)
'''


@pytest.fixture(scope="session")
def match_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("series")
    (folder / "few_brains.py").write_text(BRAINS)
    path = folder / "match.toml"
    path.write_text(
        f'duration = 1.0\nrules = "{BRISK}"\n'
        '[teams.cyan]\nname = "Forward"\nbrain = "few_brains:Forward"\nsize = 1\n'
        '[teams.magenta]\nname = "Still"\nbrain = "few_brains:Still"\nsize = 1\n'
    )
    return path
