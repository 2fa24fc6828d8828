from robot_agent.process.stdio.answers import AnswerFault
from robot_agent.process.stdio.fault_counts import FaultCounts


def test_the_first_the_tenth_and_the_hundredth_fault_of_a_kind_are_logged() -> None:
    counts = FaultCounts()
    logged = [line for _ in range(150) if (line := counts.add(AnswerFault.STRAY, "wrote 'x'")) is not None]
    noun = "lines that were no JSON object so far"
    assert logged == ["wrote 'x'", f"wrote 'x' (10 {noun})", f"wrote 'x' (100 {noun})"]
    assert counts.add(AnswerFault.SILENT, "silent") == "silent"


def test_the_summary_has_every_count() -> None:
    counts = FaultCounts()
    assert counts.summary() == ""
    for kind in AnswerFault:
        counts.add(kind, "it")
    assert counts.summary().count(",") == len(AnswerFault) - 1
