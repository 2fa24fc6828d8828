"""What each account may do is what the topic table says, in both directions."""

import pytest

from runtime.access.access_rules import access_rules
from runtime.access.accounts import ACCOUNTS, Account
from runtime.access.rights import Rights
from schemas.side import Side
from schemas.tokens import TOKENS, PresenceKind
from schemas.topic import Delivery, Party
from schemas.topics import TOPICS, key_prefix

ROBOTS = {side: [f"{side.value}{number}" for number in (1, 2)] for side in Side}
RIGHTS = {account: Rights(account, ROBOTS) for account in Account}
PUBLISHED = [name for name, topic in TOPICS.items() if topic.delivery not in (Delivery.QUERY, Delivery.PRESENCE)]
QUERIED = [name for name, topic in TOPICS.items() if topic.delivery is Delivery.QUERY]


def accounts_of(parties: tuple[Party, ...]) -> set[Account]:
    return {account for account, row in ACCOUNTS.items() if not set(row.parties).isdisjoint(parties)}


def accounts_with(name: str, kind: str) -> set[Account]:
    """The accounts that have a key of this topic in the list `kind` of their rights."""
    return {account for account, rights in RIGHTS.items() if any(is_of(name, key) for key in getattr(rights, kind))}


def is_of(name: str, key: str) -> bool:
    """Whether a key is one of this topic: `world/ball` is no `world/{robot}`."""
    is_literal = any(topic.key == key for topic in TOPICS.values())
    return TOPICS[name].key == key if is_literal else TOPICS[name].match(key) is not None


@pytest.mark.parametrize("name", PUBLISHED)
def test_a_topic_is_published_and_subscribed_to_by_the_parties_of_its_row_alone(name: str) -> None:
    topic = TOPICS[name]
    assert accounts_with(name, "publishes") == accounts_of(topic.writers)
    assert accounts_with(name, "subscribes") == accounts_of(topic.readers)
    recovered = accounts_of(topic.readers) if topic.delivery is Delivery.RECOVERED else set()
    assert accounts_with(name, "recovers") == recovered


@pytest.mark.parametrize("name", QUERIED)
def test_a_query_is_sent_and_answered_by_the_parties_of_its_row_alone(name: str) -> None:
    topic = TOPICS[name]
    assert accounts_with(name, "queries") == (accounts_of(topic.writers) if topic.names_sender else set())
    assert accounts_with(name, "serves") == accounts_of(topic.readers)


@pytest.mark.parametrize("kind", PresenceKind)
def test_a_token_is_declared_and_seen_by_the_parties_of_its_row_alone(kind: PresenceKind) -> None:
    start = f"alive/{kind.value}/"
    declaring = {one for one, rights in RIGHTS.items() if any(key.startswith(start) for key in rights.declares)}
    seeing = {one for one, rights in RIGHTS.items() if any(key.startswith(start) for key in rights.sees)}
    assert declaring == accounts_of(TOKENS[kind].writers)
    assert seeing == accounts_of(TOKENS[kind].readers)


@pytest.mark.parametrize("side", Side)
def test_a_team_and_its_coach_have_no_key_of_the_other_side(side: Side) -> None:
    other = side.opponent.value
    for account in (Account.of_team(side), Account.of_coach(side)):
        rights = RIGHTS[account]
        own = [*rights.publishes, *rights.queries, *rights.serves, *rights.declares]
        assert not [key for key in (*own, *rights.subscribes) if other in key]
        assert not [key for key in own if key.startswith(("robot/*", "team/*"))]


def test_the_host_alone_answers_and_publishes_what_is_the_host_s() -> None:
    of_host = [topic for topic in TOPICS.values() if topic.writer is Party.HOST]
    for rights in RIGHTS.values():
        assert all(key.startswith("record/") for key in rights.serves)
        assert not [key for topic in of_host for key in rights.publishes if topic.match(key) is not None]
        assert not [key for key in rights.declares if key.startswith(("alive/host/", "alive/replay/"))]


def test_each_rule_is_of_one_account_and_of_this_match() -> None:
    rules = access_rules("cup", ROBOTS)
    assert rules["default_permission"] == "deny" and rules["enabled"] is True
    assert [policy["subjects"] for policy in rules["policies"]] == [[account.value] for account in Account]
    for policy in rules["policies"]:
        assert all(name.startswith(f"{policy['subjects'][0]} ") for name in policy["rules"])
    keys = {key for rule in rules["rules"] for key in rule["key_exprs"]}
    assert keys - {"touchline/*/alive/host/*"} == {key for key in keys if key.startswith(key_prefix("cup"))}
    assert {rule["permission"] for rule in rules["rules"]} == {"allow"}


def test_no_rule_lets_an_account_in_under_a_wider_key_than_its_rights() -> None:
    for rule in access_rules("cup", ROBOTS)["rules"]:
        rights = RIGHTS[Account(rule["id"].split()[0])]
        if rule["messages"] == ["put"] and rule["flows"] == ["ingress"]:
            assert [key.removeprefix(key_prefix("cup")) for key in rule["key_exprs"]] == rights.publishes
        assert not [key for key in rule["key_exprs"] if key.endswith("/**") and not key.endswith("/@adv/**")]
