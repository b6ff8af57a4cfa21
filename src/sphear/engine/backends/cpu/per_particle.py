"""The stage that computes fields of each particle from its own fields."""

from __future__ import annotations

from sphear.engine.backends.cpu.particle_text import (
    ELEMENTARY,
    RANGES,
    Fields,
    element,
    forms,
    parameters_text,
    reads_text,
)
from sphear.engine.backends.cpu.written import WrittenStage
from sphear.engine.point_formula import traced_point
from sphear.engine.stages import PerParticle


def per_particle(of: PerParticle, fields: Fields, parameters: str) -> WrittenStage:
    """Write the stage of a formula.

    Args:
        of: the stage.
        fields: that there are.
        parameters: the name of the array of its numbers.
    """
    traced = traced_point(of.formula, forms(fields))
    stage = WrittenStage(type(of.formula).__name__)
    stage.imports = [ELEMENTARY]
    parameters_text(stage, traced.parameter_count, parameters)
    elsewhere = dict.fromkeys(of.nearest, "near")
    lines = reads_text(stage, traced, fields, "i", elsewhere) + list(traced.lines)
    lines += [f"{element(stage, fields, name, k, 'i')} = {value}" for name, k, value in traced.writes]
    if of.nearest:
        stage.view("nearest", "nearest", "integers", "PARTICLES")
        lines.insert(0, "near = nearest[i]")
    for name, size in (("count", "FLUID"), ("total", "PARTICLES"), ("parts", "PARTS")):
        stage.size(name, size)
    low, high = RANGES[of.rows]
    stage.body += [
        f"rows = {high} - {low}",
        "for part in prange(parts):",
        f"    for i in range({low} + rows * part // parts, {low} + rows * (part + 1) // parts):",
        *(f"        {line}" for line in lines),
    ]
    return stage
