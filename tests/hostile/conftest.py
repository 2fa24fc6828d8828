"""The page's server and bridges for attacks on their ports."""

from support.page_fixtures import ending_gateways, gateway_of, host, host_of, medium, tokens, visit

__all__ = ["ending_gateways", "gateway_of", "host", "host_of", "medium", "tokens", "visit"]
