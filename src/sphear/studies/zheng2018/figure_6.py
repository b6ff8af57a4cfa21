"""Figure 6: time against the number of particles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from sphear.references.zheng2018 import SIZES, TERMS
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.zheng2018 import table_3
from sphear.studies.zheng2018.convergence_figures import curves
from sphear.studies.zheng2018.patch import first, last

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CLAIM = "the time of all four terms grows in proportion to the number of particles"


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """Table 3 as curves."""
    timed = table_3.run(quick=quick, progress=progress)
    span = math.log((SIZES[-1] / SIZES[0]) ** 2)
    growth = {
        name: math.log(last(timed.rows, name, "computed") / first(timed.rows, name, "computed")) / span
        for name in TERMS.values()
    }
    finding = (
        f"from {SIZES[0]} to {SIZES[-1]} particles a side the time grows with the number of particles to the power"
        f" {min(growth.values()):.2f} to {max(growth.values()):.2f}, below 1 because a call costs some time however few"
        f" the particles"
    )
    agrees: Agreement = "yes" if min(growth.values()) > 0.85 else "partly"
    return StudyResult(CLAIM, finding, agrees, timed.rows, timed.tables, {"figure-6": lambda: _figure(timed.rows)})


def _figure(rows: list[dict[str, Any]]) -> Figure:
    from sphear.results.figure import Convergence, convergence_panels

    panels = [
        Convergence(curves(rows, key), label, (2,) if key == "published" else ())
        for key, label in (("published", "published, s"), ("computed", "computed, s"))
    ]
    return convergence_panels(panels, "particles a side", "Time of one Laplacian (Zheng, Ma & Shao 2018, figure 6)")
