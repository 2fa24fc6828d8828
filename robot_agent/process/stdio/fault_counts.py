"""Counts the faults of a program, and selects those to log: the first of a kind, the tenth, the hundredth, …"""

from collections import Counter

from robot_agent.process.stdio.answers import AnswerFault

_NOUNS = {
    AnswerFault.STRAY: "lines that were no JSON object",
    AnswerFault.INVALID: "lines that were no command",
    AnswerFault.SECOND: "second answers",
    AnswerFault.OTHER_TICK: "answers to other ticks",
    AnswerFault.LATE: "late answers",
    AnswerFault.SILENT: "sights without an answer",
    AnswerFault.UNREAD: "times a sight stayed unread",
}


class FaultCounts:
    """The faults of one program."""

    def __init__(self) -> None:
        self.counts: Counter[AnswerFault] = Counter()

    def add(self, kind: AnswerFault, sentence: str) -> str | None:
        """Count a fault; the line to log, or None if this one is not logged."""
        self.counts[kind] += 1
        count = self.counts[kind]
        if count == 1:
            return sentence
        is_power_of_ten = str(count).strip("0") == "1"
        return f"{sentence} ({count} {_NOUNS[kind]} so far)" if is_power_of_ten else None

    def summary(self) -> str:
        """All counts in one line; empty without a fault."""
        return ", ".join(f"{count} {_NOUNS[kind]}" for kind, count in self.counts.items())
