"""Runs one program of lines on the bus, as `robot_agent.process.runner.Runner` runs a brain."""

from robot_agent.process.runner import Runner
from robot_agent.process.stdio.program import StdioProgram
from schemas.messages.sight import Sight


class ProgramRunner(Runner):
    """Passes each sight to a program, and its answers to the host. A slow program does not keep the agent waiting."""

    def answer(self, sight: Sight) -> None:
        """Send the commands that the program writes within a while; a repeated sight gets the same
        command again.

        Raises:
            ProgramEndedError: the program has ended.
        """
        program = self.brain
        assert isinstance(program, StdioProgram)
        self._clock.sim_ns = round(sight.time * 1e9)
        if sight.tick == self._last_tick:
            self._repeat()
            return
        owed = True
        while owed:
            found = program.exchange(sight)
            for payload in found.others:
                self._commands.put_payload(payload)
            if found.answer is not None:
                self._last_tick, self._last_answer = found.tick, found.answer
                self._send()
            owed = found.answer is not None and found.tick != sight.tick  # it has answered an older sight
