"""The same scene from many seeds, and assertions on how many of them do what they should."""

from collections.abc import Callable, Iterator, Sequence

from touchline.testing.facts import Facts

Condition = Callable[[Facts], object]
"""Whether a run is as it should be; an AssertionError counts as no."""
_SHOWN = 5
"""Most runs that a message describes."""


class Runs:
    """What happened in each run; a sequence of `Facts`, in the order of the seeds."""

    def __init__(self, facts: Sequence[Facts]) -> None:
        self.facts = facts

    def __iter__(self) -> Iterator[Facts]:
        return iter(self.facts)

    def __len__(self) -> int:
        return len(self.facts)

    def count(self, condition: Condition) -> int:
        """In how many runs the condition is true."""
        return sum(_holds(condition, one)[0] for one in self.facts)

    def at_least(self, number: int, condition: Condition) -> None:
        """Assert that the condition is true in at least so many runs.

        Raises:
            AssertionError: it is not; the message describes the runs in which it is not true.
        """
        __tracebackhide__ = True
        self._check(condition, f"at least {number}", lambda count: count >= number, shown=False)

    def at_most(self, number: int, condition: Condition) -> None:
        """Assert that the condition is true in at most so many runs.

        Raises:
            AssertionError: it is not; the message describes the runs in which it is true.
        """
        __tracebackhide__ = True
        self._check(condition, f"at most {number}", lambda count: count <= number, shown=True)

    def always(self, condition: Condition) -> None:
        """Assert that the condition is true in all runs."""
        __tracebackhide__ = True
        self._check(condition, "all", lambda count: count == len(self.facts), shown=False)

    def never(self, condition: Condition) -> None:
        """Assert that the condition is true in no run."""
        __tracebackhide__ = True
        self._check(condition, "none", lambda count: count == 0, shown=True)

    def _check(self, condition: Condition, wanted: str, is_met: Callable[[int], bool], *, shown: bool) -> None:
        __tracebackhide__ = True
        if not self.facts:
            raise AssertionError("no seed was played; give seeds=range(20)")
        results = [(one, *_holds(condition, one)) for one in self.facts]
        count = sum(holds for _, holds, _ in results)
        if is_met(count):
            return
        described = [f"  {why or one}" for one, holds, why in results if holds is shown]
        more = [f"  and {len(described) - _SHOWN} more"] if len(described) > _SHOWN else []
        head = f"{count} of {len(results)} seeds, {wanted} wanted; {'these' if shown else 'not these'}:"
        raise AssertionError("\n".join([head, *described[:_SHOWN], *more]))


def _holds(condition: Condition, facts: Facts) -> tuple[bool, str]:
    """Whether the condition is true, and the message of its own assertion if that failed."""
    try:
        return bool(condition(facts)), ""
    except AssertionError as error:
        return False, str(error)
