"""Figure 5: convergence on jittered particles."""

from __future__ import annotations

from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.zheng2018 import convergence, table_2
from sphear.studies.zheng2018.patch import JITTER

CLAIM = "the convergence rate of VISC-03 is near first order in N, the other three terms do not reach it"


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """Table 2 as curves."""
    table = table_2.run(quick=quick, progress=progress)
    paper = convergence.orders_in_particles(table.rows, "computed")
    honest = convergence.orders_in_particles(table.rows, "l1_relative")
    finding = (
        f"Err falls with k = {paper['schwaiger']:.2f} for VISC-03 and {paper['morris']:.2f}, {paper['gotoh']:.2f} and"
        f" {paper['oger']:.2f} for VISC-01, VISC-02 and VISC-04, but without the division by the number of samples k is"
        f" {honest['schwaiger']:+.2f} and {honest['morris']:+.2f}, {honest['gotoh']:+.2f}, {honest['oger']:+.2f}:"
        f" VISC-03 does not converge and the other three diverge like 1/dx"
    )
    as_claimed = abs(paper["schwaiger"] - 1) < 0.2 and all(
        paper[name] < paper["schwaiger"] - 0.2 for name in paper if name != "schwaiger"
    )
    converges = honest["schwaiger"] > 0.1
    agrees: Agreement = "yes" if as_claimed and converges else "partly" if as_claimed else "no"
    title = f"Patch test on particles jittered by {JITTER} dx (Zheng, Ma & Shao 2018, figure 5)"
    return StudyResult(
        CLAIM, finding, agrees, table.rows, table.tables,
        {"figure-5": lambda: convergence.figure(table.rows, title, (1,))}, table.other_readings,
    )  # fmt: skip
