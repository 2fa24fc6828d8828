"""The TCP connections of this process: their received bytes by peer, and their end."""

import os
import resource
import socket
import struct
from pathlib import Path

import pytest

from schemas.process.open_sockets import (
    close_connection,
    close_in_background,
    duplicate,
    plain_address,
    received_bytes,
)

linux = pytest.mark.skipif(not hasattr(socket, "TCP_INFO"), reason="only Linux reports the bytes of a connection")


@pytest.fixture
def pair():
    with socket.create_server(("127.0.0.1", 0)) as listener:
        client = socket.create_connection(listener.getsockname())
        server, peer = listener.accept()
        with client, server:
            yield client, server, peer


@linux
def test_the_received_bytes_are_those_of_the_connection_to_a_peer(pair):
    client, server, peer = pair
    assert received_bytes()[peer] == 0
    client.sendall(b"x" * 5000)
    server.recv(5000, socket.MSG_WAITALL)
    assert received_bytes()[peer] == 5000


@linux
def test_a_closed_connection_ends_at_both_ends_even_if_its_peer_never_reads(pair):
    client, server, peer = pair
    server.setblocking(False)
    with pytest.raises(BlockingIOError):
        while True:
            server.send(b"x" * 100_000)
    assert close_connection(peer)
    assert server.recv(1) == b""
    server.close()  # as the library does that reads the end
    with pytest.raises(ConnectionResetError):
        while client.recv(10**6):
            pass
    assert not close_connection(peer)


@linux
def test_nobody_waits_who_closes_a_connection_in_the_background_and_its_peer_receives_all(pair):
    client, server, peer = pair
    server.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 10))
    assert close_in_background(peer)
    assert struct.unpack("ii", server.getsockopt(socket.SOL_SOCKET, socket.SO_LINGER, 8))[0] == 0
    server.setblocking(False)
    sent = 0
    with pytest.raises(BlockingIOError):
        while True:
            sent += server.send(b"x" * 100_000)
    server.close()
    received = 0
    while part := client.recv(10**6):
        received += len(part)
    assert received == sent
    assert not close_in_background(peer)


@linux
def test_no_descriptor_is_left_open(pair):
    _, _, peer = pair
    before = len(list(Path("/proc/self/fd").iterdir()))
    received_bytes()
    close_connection(peer)
    assert not close_connection(("127.0.0.1", 1))
    assert len(list(Path("/proc/self/fd").iterdir())) == before


@linux
def test_the_duplicate_of_what_is_no_socket_is_refused_and_leaves_no_descriptor_open(tmp_path):
    before = len(list(Path("/proc/self/fd").iterdir()))
    with (tmp_path / "file").open("w") as file, pytest.raises(OSError, match="non-socket"):
        duplicate(file.fileno())
    assert len(list(Path("/proc/self/fd").iterdir())) == before


@linux
def test_a_connection_that_another_thread_closes_meanwhile_is_left_out(pair, monkeypatch):
    client, server, peer = pair
    own = server.getsockname()
    closing, name_of_peer = client.fileno(), socket.socket.getpeername

    def close_after(connection):
        found = name_of_peer(connection)
        if connection.fileno() == closing:
            os.close(client.detach())
        return found

    monkeypatch.setattr(socket.socket, "getpeername", close_after)
    received = received_bytes()
    assert own not in received
    assert peer in received


@linux
def test_without_a_free_descriptor_no_connection_is_found_and_nothing_fails(pair):
    _, _, peer = pair
    before = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (3, before[1]))
    try:
        assert received_bytes() == {}
        assert not close_connection(peer)
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, before)
    assert peer in received_bytes()


@pytest.mark.parametrize(
    ("address", "plain"),
    [("10.0.0.1", "10.0.0.1"), ("::ffff:10.0.0.1", "10.0.0.1"), ("fe80::1%eth0", "fe80::1"), ("host", "host")],
)
def test_an_address_has_one_form(address, plain):
    assert plain_address(address) == plain
