"""How the MCAP files of this project are written: the stock writer, with the same settings everywhere."""

from typing import IO

from mcap.writer import CompressionType, Writer

CHUNK_BYTES = 256 * 1024
"""Uncompressed size of a chunk: as small as compresses well, and stays in the cache."""


def mcap_writer(file: IO[bytes]) -> Writer:
    """A writer of zstd chunks with all indexes and all checksums."""
    return Writer(file, chunk_size=CHUNK_BYTES, compression=CompressionType.ZSTD, enable_data_crcs=True)
