"""The methods of wall models of the incompressible scheme; as they are here, fields are those at mirror points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple, get_args

from sphear.boundaries.continuations import LeaningParabola, Line, Mirror, Wall
from sphear.boundaries.models.any_model import AnyWallModel
from sphear.errors import SphearError, quoted
from sphear.kernels import Kernel

if TYPE_CHECKING:
    import numpy as np
    from scipy.sparse import csr_array

    from sphear.boundaries.shapes import Dummies
    from sphear.neighbours import Domain
    from sphear.schemes.incompressible.walls import WallInterpolation, Walls

    Array = np.ndarray[Any, Any]

Continuation = Literal["mirror", "linear", "quadratic", "wall"]
Divergence = Literal["slipping", "continued"]

FIRST_ROW = 0.75  # spacings behind a wall, up to which its first row is; beyond a corner it is 0.71
REACH = 3.0  # spacings around a mirror point: some 14 particles for a plane
CURVES = {"linear": Line(), "quadratic": LeaningParabola()}  # that are fitted before a wall


class Sampling(NamedTuple):
    """Where and how the fluid's fields are taken for dummy particles.

    points: (W, d), where.
    kernel: of the weights around them.
    order: 0 for the mean around a point, 1 for a plane.
    """

    points: Array
    kernel: Kernel
    order: int


@dataclass(frozen=True)
class WallModel(AnyWallModel):
    """Dummy particles behind walls of incompressible flow, and what they have of the fluid's fields.

    Args:
        continuation: how the velocity goes on behind a wall in the viscous term: "mirror", "linear", "quadratic", or
            not at all, "wall": dummy particles have that of the wall.
        divergence: velocity of dummy particles along the wall in the divergence: the fluid's own, "slipping", or the
            one that is "continued" for the viscous term.

    Attributes:
        surface_fault: why the model does not go with a free surface; empty where it does.
        symmetric: the rows of the pressure equation know nothing of walls, so that its matrix stays symmetric.

    Raises:
        SphearError: a field is none of these.

    Examples:
        >>> import sphear
        >>> isinstance(sphear.SFDI(), sphear.WallModel)
        True
        >>> sphear.MirrorPoints().surface_fault, sphear.SFDI().surface_fault
        ('', 'needs fluid before every wall')
    """

    continuation: Continuation = "quadratic"
    divergence: Divergence = "slipping"

    surface_fault: ClassVar[str] = ""
    symmetric: ClassVar[bool] = False

    def __post_init__(self) -> None:
        for key, allowed in (("continuation", get_args(Continuation)), ("divergence", get_args(Divergence))):
            if (value := getattr(self, key)) not in allowed:
                raise SphearError(
                    f"the {key} of the wall model {type(self).__name__} should be one of {', '.join(allowed)}, not"
                    f" {quoted(value)}"
                )

    @property
    def curve(self) -> Line | None:
        """The curve that continues velocities; None of continuations that fit none."""
        return CURVES.get(self.continuation)

    def wall_particles(self, behind: Dummies, spacing: float, window: Domain) -> Dummies:
        """The W particles that stand for the walls: the dummies behind them, after any on them.

        Args:
            behind: the dummies.
            spacing: of the particles.
            window: that the flow repeats with.
        """
        return behind

    def sampling(self, behind: Dummies, kernel: Kernel, spacing: float) -> Sampling:
        """Where the fields of dummies are taken, and how: a plane around their mirror points.

        Args:
            behind: the wall particles.
            kernel: of the scheme, with its smoothing length.
            spacing: of the particles.
        """
        images = behind.feet + behind.depths[:, None] * behind.normals
        return Sampling(images, type(kernel)(REACH * spacing / kernel.support), 1)

    def way(self, walls: Walls, interpolation: WallInterpolation, positions: Array) -> Array:
        """(W, d): from wall particles to where their fields are taken, across the wall.

        Args:
            walls: the wall particles.
            interpolation: of the fluid's fields.
            positions: (N, d), of the fluid.
        """
        result: Array = 2.0 * walls.depths[:, None] * walls.normals
        return result

    def continued(self, walls: Walls, interpolation: WallInterpolation, velocities: Array) -> Array:
        """(W, d): velocities behind walls that give the wall's velocity on it.

        Args:
            walls: the wall particles.
            interpolation: of the fluid's fields.
            velocities: (N, d), of the fluid.
        """
        if self.continuation == Wall.name:
            still: Array = Wall.behind(walls.velocities)
            return still
        if interpolation.continued is None:
            behind: Array = Mirror.behind(walls.velocities, interpolation.mirrored @ velocities)
            behind[: walls.on_wall] = walls.velocities[: walls.on_wall]
            return behind
        import numpy as np  # takes long: models are listed without it

        total = np.asarray(interpolation.continued.sum(axis=1)).reshape(-1, 1)
        fitted: Array = interpolation.continued @ velocities + (1.0 - total) * walls.velocities
        return fitted

    def own_pressures(self, walls: Walls) -> int:
        """S, the number of wall particles that have a pressure of their own, an unknown of the equation; the first."""
        return 0

    def jump(self, walls: Walls, accelerations: Array, density: float, way: Array) -> Array:
        """(W - S,), p_w minus the pressure it is continued from, -w . grad p over the way w between the two.

        Args:
            walls: the wall particles.
            accelerations: (W, d), grad p over the density: that the pressure balances at the walls.
            density: of the fluid.
            way: (W, d), w.
        """
        import numpy as np  # see above

        result: Array = -density * np.einsum("wd,wd->w", accelerations, way)
        return result

    def pressure_weights(
        self, walls: Walls, interpolation: WallInterpolation, column: Array, unknowns: int
    ) -> csr_array | None:
        """(W - S, unknowns): pressures behind walls, without their jump, as sums over the unknowns.

        None leaves walls out of the equation.

        Args:
            walls: the wall particles.
            interpolation: of the fluid's fields.
            column: (N + W,), the unknown of each particle.
            unknowns: their number, N + S.
        """
        from scipy.sparse import csr_array  # takes long: models are listed without it

        mirrored = interpolation.mirrored
        return csr_array(
            (mirrored.data, column[mirrored.indices], mirrored.indptr), shape=(mirrored.shape[0], unknowns)
        )

    def pressures_behind(
        self, walls: Walls, interpolation: WallInterpolation, fluid: Array, on_walls: Array, jump: Array
    ) -> Array:
        """(W,): the pressures of wall particles, from those of the fluid (N,) and of particles on walls (S,)."""
        mirrored: Array = interpolation.mirrored @ fluid
        return mirrored + jump if len(jump) else mirrored

    def own_equations(self, walls: Walls, fluid: Array, unknown: Array) -> csr_array:
        """(S, N + S), the equations of wall particles that have a pressure of their own.

        Args:
            walls: the wall particles.
            fluid: (N, d), positions of the fluid's particles.
            unknown: (N + W,), the unknown of each particle.
        """
        from scipy.sparse import csr_array  # takes long: models are listed without it

        return csr_array((0, len(fluid)))
