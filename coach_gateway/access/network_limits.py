"""Rate limits of client networks: a network that floods takes nothing from the others. Pure."""

from collections import OrderedDict
from collections.abc import Hashable

from coach_gateway.access.rate_limit import TokenBucket

MOST_KEPT = 1024
"""Networks whose limits are kept; of more, the ones that were quiet for the longest time begin anew."""


class NetworkLimits:
    """A rate limit for each network, or for each other kind of sender."""

    def __init__(self, per_second: float, at_once: float) -> None:
        self._per_second, self._at_once = per_second, at_once
        self._buckets: OrderedDict[Hashable, TokenBucket] = OrderedDict()

    def __len__(self) -> int:
        return len(self._buckets)

    def allow(self, network: Hashable, now: float) -> bool:
        """Whether one more of this network is allowed at wall time `now` in s; if so, it is counted."""
        return self._bucket(network, now).allow(now)

    def count(self, network: Hashable, now: float, amount: float) -> None:
        """Count an amount in any case; what is beyond the limit has to pass before one more is allowed."""
        self._bucket(network, now).delay(now, amount)

    def is_spent(self, network: Hashable, now: float) -> bool:
        """Whether a network is over its limit; counts nothing."""
        bucket = self._buckets.get(network)
        return bucket is not None and not bucket.has_room(now)

    def _bucket(self, network: Hashable, now: float) -> TokenBucket:
        """The limit of a network, from now on the newest."""
        bucket = self._buckets.pop(network, None) or TokenBucket(self._per_second, self._at_once, now)
        self._buckets[network] = bucket
        if len(self._buckets) > MOST_KEPT:
            self._buckets.popitem(last=False)
        return bucket
