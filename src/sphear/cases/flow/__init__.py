"""Flows: geometry, initial state, reference solution, and when a run ends."""

from __future__ import annotations

from sphear.cases.flow.base import Case, Comparison
from sphear.cases.flow.cavity import CAVITY
from sphear.cases.flow.cavity_cylinder import CAVITY_CYLINDER
from sphear.cases.flow.couette import COUETTE
from sphear.cases.flow.dam_break import DAM_BREAK
from sphear.cases.flow.poiseuille import POISEUILLE
from sphear.cases.flow.run import CaseRun
from sphear.cases.flow.start import flow
from sphear.cases.flow.taylor_green import TAYLOR_GREEN
from sphear.names import Registry

FLOWS: Registry[Case] = Registry("case")
for _case in (POISEUILLE, COUETTE, TAYLOR_GREEN, CAVITY, CAVITY_CYLINDER, DAM_BREAK):
    FLOWS.add(_case.name, _case)

__all__ = ["FLOWS", "Case", "CaseRun", "Comparison", "flow"]
