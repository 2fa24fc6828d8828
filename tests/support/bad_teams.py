"""Teams that a cup must survive, as the source of a module beside its file."""

SOURCE = '''
"""Teams that fail, each in its own way."""

import os
import time
from pathlib import Path

from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from schemas.topics import COMMAND
from touchline import Briefing, Command, Drive, Kick, KickMode, Sight


class Sound:
    def __init__(self, briefing: Briefing) -> None:
        self.robot = briefing.robot

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick)


class Crashes(Sound):
    def act(self, sight: Sight) -> Command:
        raise ValueError("no ball")


class Hangs(Sound):
    def act(self, sight: Sight) -> Command:
        while sight.tick >= 60:
            time.sleep(0.01)
        return super().act(sight)


class NeverStarts(Sound):
    def __init__(self, briefing: Briefing) -> None:
        raise RuntimeError("no camera")


class Cheats(Sound):
    """Kicks a ball that it does not have, in turn at once and long after the sight that it answers."""

    def act(self, sight: Sight) -> Command:
        kick = Kick(mode=KickMode.GROUND, speed=10.0)
        return Command(answers_tick=max(0, sight.tick - 200 * (sight.tick % 2)), drive=Drive(vx=20.0), kick=kick)


class Floods(Sound):
    """Sends more commands for each sight than the host admits in the longest time that it waits for an answer."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self.publisher = None

    def act(self, sight: Sight) -> Command:
        if self.publisher is None:
            match, connect, credentials = (os.environ[f"TOUCHLINE_{n}"] for n in ("MATCH", "CONNECT", "CREDENTIALS"))
            self.bus = open_client(match, WallClock(), connect, 10.0, Path(credentials))
            self.publisher = self.bus.publisher(COMMAND, robot=self.robot)
        for _ in range(4000):  # 1000 a second are admitted, and an answer takes at most 3 s
            self.publisher.put(Command(answers_tick=1))
        return super().act(sight)
'''
