"""Divergence-free velocities: the curl of a scalar field, with its exact Laplacian."""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.cases.fields import Field

Array = np.ndarray[Any, Any]


def stream_velocity(field: Field, positions: Array, sample: Array) -> tuple[Array, Array]:
    """u = curl(f) at the positions, (N, d), and lap u = curl(lap f) at the sample, (M, d).

    In 2-D f is the stream function, u = (df/dy, -df/dx). In 3-D the vector potential is (f, f, f).
    """
    gradient = [derivative(positions) for derivative in field.gradient]
    of_laplacian = [derivative(sample) for derivative in field.laplacian.gradient()]
    return _curl(gradient), _curl(of_laplacian)


def _curl(gradient: list[Array]) -> Array:
    if len(gradient) == 2:
        return np.stack((gradient[1], -gradient[0]), axis=1)
    x, y, z = gradient
    return np.stack((y - z, z - x, x - y), axis=1)
