"""Flows: geometry, initial state, reference solution, and when a run ends."""

from __future__ import annotations

from sphear.cases.flow.base import FlowCase, FlowRun
from sphear.cases.flow.couette import COUETTE
from sphear.cases.flow.poiseuille import POISEUILLE
from sphear.cases.flow.taylor_green import TAYLOR_GREEN
from sphear.names import Registry

FLOWS: Registry[FlowCase] = Registry("case")
for _case in (POISEUILLE, COUETTE, TAYLOR_GREEN):
    FLOWS.add(_case.name, _case)

__all__ = ["FLOWS", "FlowCase", "FlowRun"]
