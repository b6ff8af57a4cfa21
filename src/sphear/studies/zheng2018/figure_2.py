"""Figure 2: the Laplacian along x = 0.5 on a lattice."""

from __future__ import annotations

from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.zheng2018 import profile

CLAIM = "all four terms agree very well with the exact Laplacian on uniform particles"


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """Profiles on a lattice of 20 intervals."""
    rows = profile.rows_along_line(jitter=0.0)
    off = profile.deviations(rows)
    finding = "the mean deviations are " + ", ".join(f"{x:.2%} for {name}" for name, x in off.items())
    finding += " of the largest exact value"
    agrees: Agreement = "yes" if max(off.values()) < 0.02 else "no"
    title = "Laplacian along x = 0.5 on a lattice, dx = 0.05 (Zheng, Ma & Shao 2018, figure 2)"
    return StudyResult(
        CLAIM, finding, agrees, rows, [profile.table(title, rows)], {"figure-2": lambda: profile.figure(rows, title)}
    )
