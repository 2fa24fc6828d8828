"""Makes the page of a package index from the README: links to files of the repository would lead nowhere there."""

import re
from pathlib import Path

from hatchling.metadata.plugin.interface import MetadataHookInterface

IMAGE = re.compile(r"!\[[^\]]*\]\((?!https?:)[^)]*\)\n+")
LINK = re.compile(r"\[([^\]]+)\]\((?!https?:)([^)#]+)[^)]*\)")


class IndexPage(MetadataHookInterface):
    """Gives the project its description."""

    def update(self, metadata: dict) -> None:
        """Set the README without images, and with the paths of files in place of links."""
        text = (Path(self.root) / "README.md").read_text("utf-8")
        page = LINK.sub(r"\1 (`\2`)", IMAGE.sub("", text))
        metadata["readme"] = {"content-type": "text/markdown", "text": page}
