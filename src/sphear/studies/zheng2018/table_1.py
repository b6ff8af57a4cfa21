"""Table 1: errors of the four viscous terms on a lattice."""

from __future__ import annotations

from sphear.references.zheng2018 import TABLE_1
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.zheng2018 import printed
from sphear.studies.zheng2018.patch import compared, error_table, last, settings

CLAIM = "on uniform particles VISC-01 and VISC-02 converge with first order, VISC-03 and VISC-04 with second"


def three_digits(row: dict[str, float]) -> bool:
    """True if the computed error, rounded as the paper prints it, is the published one."""
    return f"{row['computed']:.2e}" == f"{row['published']:.2e}"


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """Table 1 and, as other readings, eq. 16 as printed."""
    rows = compared(settings(), TABLE_1, progress)
    other = printed.rows(progress)
    same = sum(map(three_digits, rows))
    order = {name: last(rows, name, "order") for name in TABLE_1}
    stalled = [name for name in ("morris", "gotoh") if abs(order[name]) < 0.2]
    second = min(order["schwaiger"], order["oger"])
    finding = (
        f"{same} of {len(rows)} entries come out to the printed three digits (the last of VISC-02 against 6.45e-7:"
        f" 6.45e-6 is a misprint), but Err is the L1-relative error divided by the number of samples once more: the"
        f" error itself stays at {last(rows, 'morris', 'l1_relative'):.1%} for VISC-01 and"
        f" {last(rows, 'gotoh', 'l1_relative'):.1%} for VISC-02 (orders {order['morris']:+.2f} and"
        f" {order['gotoh']:+.2f}), and VISC-03 and VISC-04 converge with order {second:.2f}; eq. 16 as printed is off"
        f" by {last(other, printed.NAME, 'l1_relative'):.0%}"
    )
    agrees: Agreement = "yes" if not stalled else "partly" if second > 1.9 else "no"
    table = error_table("Table 1 of Zheng, Ma & Shao 2018: errors on a lattice", rows)
    return StudyResult(CLAIM, finding, agrees, rows, [table], other_readings=other)
