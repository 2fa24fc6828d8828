"""The lean writer writes what the stock writer writes, byte for byte."""

import random
from collections.abc import Callable
from io import BytesIO

import pytest
from mcap.reader import make_reader
from mcap.writer import CompressionType, IndexType, Writer

from recordings.container.lean_writer import LeanWriter


def stock_writer(out: BytesIO, chunk_size: int) -> Writer:
    return Writer(
        out,
        chunk_size=chunk_size,
        compression=CompressionType.ZSTD,
        index_types=IndexType.ALL,
        enable_data_crcs=True,
    )


def lean_writer(out: BytesIO, chunk_size: int) -> Writer:
    return LeanWriter(out, chunk_size, level=3)  # the stock writer's


def written(kind: Callable[[BytesIO, int], Writer], times: list[int], chunk_size: int) -> bytes:
    """A file with messages of these log times on three channels, a flush, an attachment and metadata between them."""
    out = BytesIO()
    writer = kind(out, chunk_size)
    writer.start(profile="", library="test")
    schema = writer.register_schema("name", "jsonschema", b"{}")
    channels = [writer.register_channel(key, "json", schema, {"key": key}) for key in ("a", "b", "c")]
    rng = random.Random(3)
    for number, log_ns in enumerate(times):
        writer.add_message(rng.choice(channels), log_ns, rng.randbytes(rng.randrange(300)), log_ns + 7, number)
        if number == len(times) // 2:
            writer.flush()
            writer.add_metadata("between", {"a": "b"})
            writer.add_attachment(1, 2, "between", "text/plain", b"content")
    writer.finish()
    return out.getvalue()


@pytest.mark.parametrize("chunk_size", [100, 4096, 1 << 20])
@pytest.mark.parametrize(
    "times",
    [list(range(0, 500_000, 1000)), [2**63] * 50, random.Random(5).sample(range(10**12), 400), [5], []],
    ids=["in order", "at once and late", "in no order", "one", "none"],
)
def test_the_bytes_are_those_of_the_stock_writer(times, chunk_size):
    assert written(lean_writer, times, chunk_size) == written(stock_writer, times, chunk_size)


def test_the_stock_reader_takes_what_is_written_at_its_own_level():
    times = list(range(0, 500_000, 1000))
    files = [BytesIO(written(kind, times, 4096)) for kind in (LeanWriter, stock_writer)]
    lean, stock = (
        [(channel.topic, message.log_time, message.data) for _, channel, message in reader.iter_messages()]
        for reader in (make_reader(file, validate_crcs=True) for file in files)
    )
    assert lean == stock
    assert len(lean) == len(times)
