"""Teams that a cup must survive, as the source of a module beside its file."""

SOURCE = '''
"""Teams that fail, each in its own way."""

import os
import threading
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
    """Sends commands from a thread of its own, far more than the host admits."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self.flood = None

    def act(self, sight: Sight) -> Command:
        if self.flood is None:
            self.flood = threading.Thread(target=self._flood, daemon=True)
            self.flood.start()
        time.sleep(0.03)  # a flood breaks the limits after some seconds, in which the match must not end
        return super().act(sight)

    def _flood(self) -> None:
        match, connect, credentials = (os.environ[f"TOUCHLINE_{name}"] for name in ("MATCH", "CONNECT", "CREDENTIALS"))
        bus = open_client(match, WallClock(), connect, 10.0, Path(credentials))
        publisher = bus.publisher(COMMAND, robot=self.robot)
        while True:
            for _ in range(40):
                publisher.put(Command(answers_tick=1))
            time.sleep(0.002)
'''
