"""Figure 4: the Laplacian along x = 0.5 on jittered particles."""

from __future__ import annotations

from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.zheng2018 import profile
from sphear.studies.zheng2018.patch import JITTER

CLAIM = "on non-uniform particles VISC-03 is the most accurate, and VISC-01 and VISC-04 have the largest errors"


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """Profiles on a jittered lattice of 20 intervals."""
    rows = profile.rows_along_line(jitter=JITTER)
    off = profile.deviations(rows)
    finding = f"with a jitter of {JITTER} dx the mean deviations are "
    finding += ", ".join(f"{x:.1%} for {name}" for name, x in off.items()) + " of the largest exact value"
    ranked = sorted(off, key=off.__getitem__)
    agrees: Agreement = (
        "yes" if ranked[0] == "schwaiger" and ranked[1] == "gotoh" else "partly" if ranked[0] == "schwaiger" else "no"
    )
    title = f"Laplacian along x = 0.5, jitter {JITTER} dx, dx = 0.05 (Zheng, Ma & Shao 2018, figure 4)"
    return StudyResult(
        CLAIM, finding, agrees, rows, [profile.table(title, rows)], {"figure-4": lambda: profile.figure(rows, title)}
    )
