"""Figure 3: convergence on a lattice."""

from __future__ import annotations

from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.zheng2018 import convergence, table_1
from sphear.studies.zheng2018.patch import last

CLAIM = (
    "the errors fall with the number of particles N as N^-k, with k about 1 for VISC-01 and VISC-02 and 2 for VISC-03"
    " and VISC-04"
)


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """Table 1 as curves."""
    table = table_1.run(quick=quick, progress=progress)
    paper = convergence.orders_in_particles(table.rows, "computed")
    honest = convergence.orders_in_particles(table.rows, "l1_relative")
    finding = (
        f"Err falls with k = {paper['morris']:.2f}, {paper['gotoh']:.2f}, {paper['schwaiger']:.2f} and"
        f" {paper['oger']:.2f}, of which 1 is the division by the number of samples: the error itself has k ="
        f" {honest['morris']:.2f}, {honest['gotoh']:.2f}, {honest['schwaiger']:.2f} and {honest['oger']:.2f}, so"
        f" VISC-01 and VISC-02 do not converge and VISC-03 and VISC-04 are of order"
        f" {last(table.rows, 'schwaiger', 'order'):.1f} in dx"
    )
    as_claimed = all(abs(paper[n] - k) < 0.35 for n, k in zip(paper, (1, 1, 2, 2), strict=True))
    converges = min(honest.values()) > 0.1
    agrees: Agreement = "yes" if as_claimed and converges else "partly" if as_claimed else "no"
    title = "Patch test on a lattice (Zheng, Ma & Shao 2018, figure 3)"
    return StudyResult(
        CLAIM, finding, agrees, table.rows, table.tables,
        {"figure-3": lambda: convergence.figure(table.rows, title, (-2,))},
    )  # fmt: skip
