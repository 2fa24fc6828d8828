"""What clients of a host without credentials may do, as the router's rules say it."""

from runtime.access.access_rules import access_rules
from runtime.access.rights import Robots
from runtime.bus.zenoh.open_access import open_access
from schemas.side import Side
from schemas.topics import key_prefix

ROBOTS: Robots = {Side.CYAN: ["cyan1", "cyan2"], Side.MAGENTA: ["magenta1"]}
PREFIX = key_prefix("test")


def test_anybody_has_all_rights_of_accounts_and_may_claim_a_robot() -> None:
    section, accounts = open_access("test", ROBOTS), access_rules("test", ROBOTS)
    rules = section["rules"]
    assert rules[: len(accounts["rules"])] == accounts["rules"]
    added = {(tuple(one["flows"]), tuple(one["messages"])): one["key_exprs"] for one in rules[len(accounts["rules"]) :]}
    claim, session = [f"{PREFIX}host/claim"], [f"{PREFIX}alive/session/**"]
    assert {how: keys for how, keys in added.items() if how[1] != ("liveliness_token",)} == {
        (("ingress",), ("query",)): claim,
        (("egress",), ("reply",)): claim,
        (("egress",), ("declare_queryable",)): claim,
    }
    (tokens,) = (keys for how, keys in added.items() if how == (("ingress",), ("liveliness_token",)))
    assert len(tokens) == 1 and tokens[0].startswith(session[0][:-2])
    assert section["subjects"] == [{"id": "anybody"}]
    assert section["policies"] == [{"rules": [one["id"] for one in rules], "subjects": ["anybody"]}]
    assert {one["permission"] for one in rules[len(accounts["rules"]) :]} == {"allow"}
    assert len({one["id"] for one in rules}) == len(rules), "a name that stands twice would hide a rule"
    assert section["default_permission"] == accounts["default_permission"] == "deny" and section["enabled"]
