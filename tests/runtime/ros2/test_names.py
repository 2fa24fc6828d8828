"""Keys, tokens and attachments against the layouts of rmw_zenoh, and against two libraries that others wrote."""

import re
import struct
from types import SimpleNamespace

import pytest

from runtime.ros2 import topic_type as types
from runtime.ros2.graph_names import Attachment, Kind, NodeName, data_key, endpoint_of, gid_of, tokens_of
from runtime.ros2.message_types import PACKAGES, action_types, hash_of, service_types, typestore
from runtime.ros2.topic_type import TopicType, ros_type
from schemas.errors import TouchlineError

pytest.importorskip("xxhash")

NODE = NodeName(0, "aa11", 0, "touchline")
TWIST_KEY = "0/bot1/cmd_vel/geometry_msgs::msg::dds_::Twist_/"
TWIST_HASH = "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"
ALL = [value for value in vars(types).values() if isinstance(value, TopicType)]


def test_a_key_has_domain_topic_type_and_hash():
    assert data_key(0, "/bot1/cmd_vel", types.TWIST, hash_of(types.TWIST)) == TWIST_KEY + TWIST_HASH


def test_the_token_of_a_node_has_its_number_twice_and_no_empty_part():
    assert NODE.token == "@ros2_lv/0/aa11/0/0/NN/%/%/touchline"
    assert NODE._replace(namespace="/a/b", number=7).token == "@ros2_lv/0/aa11/7/7/NN/%/%a%b/touchline"


def test_the_token_of_an_endpoint_has_topic_type_hash_and_quality():
    token = NODE.endpoint_token(4, Kind.PUBLISHER, "/bot1/cmd_vel", types.TWIST, TWIST_HASH)
    assert token == (
        f"@ros2_lv/0/aa11/0/4/MP/%/%/touchline/%bot1%cmd_vel/geometry_msgs::msg::dds_::Twist_/{TWIST_HASH}/::,10:,:,:,,"
    )
    assert tokens_of(0, "/bot1/cmd_vel", Kind.PUBLISHER) == "@ros2_lv/0/*/*/*/MP/*/*/*/%bot1%cmd_vel/**"


@pytest.mark.parametrize(
    ("topic_type", "quality"),
    [
        (types.ODOMETRY, "::,10:,:,:,,"),
        (types.SCAN, "2::,5:,:,:,,"),
        (types.TF_STATIC, ":1:,1:,:,:,,"),
        (types.CLOCK, "2::,1:,:,:,,"),
        (TopicType("std_msgs/msg/Bool", True, 42), "::,:,:,:,,"),
    ],
)
def test_the_quality_of_service_is_written_as_by_rmw_zenoh(topic_type: TopicType, quality: str):
    assert topic_type.quality == quality


@pytest.mark.parametrize("depth", [0, -1, 10**10])
def test_a_malformed_quality_of_service_never_leaves(depth: int):
    with pytest.raises(TouchlineError, match="depth of a queue"):
        NODE.endpoint_token(1, Kind.PUBLISHER, "/x", TopicType("std_msgs/msg/Bool", depth=depth), "RIHS01_0")


def test_an_attachment_is_thirty_three_bytes():
    attachment = Attachment(7, 1_700_000_000_000_000_000, bytes(range(16)))
    raw = attachment.pack()
    assert raw == struct.pack("<qqB", 7, 1_700_000_000_000_000_000, 16) + bytes(range(16))
    assert len(raw) == 33
    assert Attachment.unpack(raw) == attachment
    assert Attachment.unpack(raw[:-1]) is None
    assert Attachment.unpack(raw[:16] + b"\x0f" + raw[17:]) is None


def test_a_token_is_read_back_and_others_are_none():
    token = NODE._replace(namespace="/cyan").endpoint_token(3, Kind.SERVICE, "/cyan1/kick", types.KICK, "RIHS01_1")
    read = endpoint_of(token)
    assert read == (token, Kind.SERVICE, "/cyan/touchline", "/cyan1/kick", "touchline_msgs/srv/Kick", "RIHS01_1")
    assert endpoint_of(NODE.token) is None
    assert endpoint_of("a/b") is None
    assert ros_type("not of ROS") == "not of ROS"


def test_pyzeros_has_the_same_identities_keys_tokens_and_qualities():
    pyzeros = pytest.importorskip("pyzeros")
    from pyzeros import pub, qos, utils

    assert pyzeros.Pub is pub.Pub
    names = {"name": "/bot1/cmd_vel", "dds_type": types.TWIST.dds, "hash": TWIST_HASH}
    assert pub.publisher_keyexpr(**names, domain_id=0) == TWIST_KEY + TWIST_HASH
    session = SimpleNamespace()  # it is not asked
    theirs = pub.token_keyexpr(
        **names, session=session, node_name="touchline", domain_id=0, _node_id=0, _zenoh_id="aa11", _entity_id=4
    )
    ours = NODE.endpoint_token(4, Kind.PUBLISHER, "/bot1/cmd_vel", types.TWIST, TWIST_HASH)
    assert theirs == ours
    assert utils.rmw_zenoh_gid(ours) == gid_of(ours)
    assert utils.ros_type_to_dds_type(types.KICK.message) == types.KICK.dds
    for one in ALL:
        durability = "transient_local" if one.latched else "volatile"
        profile = qos.QosProfile(reliability=1 if one.reliable else 2, depth=one.depth, durability=durability)
        assert profile.encode() == one.quality


def test_the_sdk_reads_every_quality_as_it_is_meant():
    pytest.importorskip("zenoh_ros2_sdk")
    from zenoh_ros2_sdk.qos import QosDurability, QosProfile, QosReliability

    for one in ALL:
        read = QosProfile.decode(one.quality)
        assert read.history_depth == one.depth
        assert (read.reliability is QosReliability.RELIABLE) == one.reliable
        assert (read.durability is QosDurability.TRANSIENT_LOCAL) == one.latched


def test_hashes_of_messages_and_services_are_those_of_another_library():
    """Of the flat types, whose hashes both libraries compute alike, and of all services."""
    pytest.importorskip("ros2_pyterfaces")
    from ros2_pyterfaces.core import all_msgs, all_srvs
    from ros2_pyterfaces.core.description import hash_rihs01

    for one in (types.CLOCK, types.ODOMETRY, types.SCAN, types.TWIST, types.TWIST_STAMPED, types.DIAGNOSTICS):
        assert hash_of(one) == hash_rihs01(getattr(all_msgs, one.message.rpartition("/")[2])), one.message
    store = typestore()
    for name, text in {
        "SetBool": "bool data\n---\nbool success\nstring message\n",
        "Trigger": "---\nbool success\nstring message\n",
    }.items():
        store.register(service_types(text, f"std_srvs/srv/{name}"))
        assert store.hash_rihs01(f"std_srvs/srv/{name}") == hash_rihs01(getattr(all_srvs, name))


def test_hashes_of_actions_are_those_of_installations():
    """As rosidl writes them in `action_msgs/srv/CancelGoal.json`, and as its action of the tutorials has them."""
    store = typestore()
    assert store.hash_rihs01("action_msgs/srv/CancelGoal") == (
        "RIHS01_573d8b0a534451d7bc2ac8c5ffde8ac14b8593b7001175d0cd6516dcbeb8689a"
    )
    name = "action_tutorials_interfaces/action/Fibonacci"
    store.register(action_types("int32 order\n---\nint32[] sequence\n---\nint32[] partial_sequence\n", name))
    assert store.hash_rihs01(f"{name}_SendGoal") == (
        "RIHS01_a0603060ed69fe2dfbd1a6f3b982a1749957ef346e4a4d2b311a05e305ec37bb"
    )
    assert store.hash_rihs01(f"{name}_FeedbackMessage") == (
        "RIHS01_50fc26b9cac313652ecbeab3adf9b5414d59fd4d4d5f9058ddcc7525169927f1"
    )


def test_a_service_has_the_hash_of_each_release_in_which_its_fields_differ():
    services = [TopicType(f"simulation_interfaces/srv/{name}") for name in ("SetEntityState", "SpawnEntity")]
    for one in services:
        assert hash_of(one) != hash_of(one._replace(version="1.x"))
    same = TopicType("simulation_interfaces/srv/StepSimulation")
    assert hash_of(same) == hash_of(same._replace(version="1.x"))


def test_the_hash_of_transforms_is_that_of_installations():
    """As `ros2 topic info -v /tf` shows it on Jazzy and Lyrical."""
    assert hash_of(types.TF) == "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"


def test_the_package_of_messages_builds_each_of_its_files_and_has_no_bytes_without_bound():
    folder = PACKAGES / "touchline_msgs"
    built = set(re.findall(r'"((?:msg|srv)/\w+\.\w+)"', (folder / "CMakeLists.txt").read_text()))
    files = {f"{path.parent.name}/{path.name}" for path in folder.glob("*/*.*")}
    assert built == files
    for path in folder.glob("*/*.*"):
        assert not re.search(r"^\s*(uint8|byte|char)\[\]", path.read_text(), re.MULTILINE)


@pytest.mark.parametrize("topic_type", ALL, ids=lambda one: f"{one.message}-{one.depth}")
def test_every_type_has_a_hash(topic_type: TopicType):
    assert re.fullmatch(r"RIHS01_[0-9a-f]{64}", hash_of(topic_type))
