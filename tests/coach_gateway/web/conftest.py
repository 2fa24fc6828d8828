"""A page's server on a port of loopback, a fake host on its bus, and visitors with real WebSockets."""

from support.page_fixtures import ending_gateways, gateway_of, host, host_of, medium, tokens, visit

__all__ = ["ending_gateways", "gateway_of", "host", "host_of", "medium", "tokens", "visit"]
