"""Tables, pictures and files of results.

Matplotlib is slow to import, so the pictures are not: take them from `sphear.results.figure` where one is drawn.
"""

from sphear.results.files import OutputFolder
from sphear.results.table import Column, Table

__all__ = ["Column", "OutputFolder", "Table"]
