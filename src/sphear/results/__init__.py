"""Tables, pictures and files of results.

Matplotlib is slow to import, so the pictures are not: take them from `sphear.results.figure` where one is drawn. Tables
and folders are imported when first used.
"""

from typing import TYPE_CHECKING

from sphear.lazy import lazy_names

if TYPE_CHECKING:
    from sphear.results.files import OutputFolder
    from sphear.results.table import Column, Table
else:
    __getattr__ = lazy_names(
        __name__, {"sphear.results.files": ("OutputFolder",), "sphear.results.table": ("Column", "Table")}
    )

__all__ = ["Column", "OutputFolder", "Table"]
