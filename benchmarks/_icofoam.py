"""The lid-driven cavity by icoFoam of OpenFOAM (Debian's `openfoam`): its case, a run, and the profiles of it.

Uniform cells, PISO with two correctors, second order in space (Gauss linear) and time (backward), the time step by a
Courant number: the settings of `sphear.references.cavity.openfoam`, with 200 x 200 cells and a Courant number of 1.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

Array = np.ndarray[Any, Any]
Lines = dict[str, tuple[Array, Array]]  # stations and values by name, as those of sphear

PROGRAMS = ("blockMesh", "icoFoam")
DEBIAN = "/usr/share/openfoam"  # where Debian's package has OpenFOAM's settings, which its programs do not find alone
NEEDED_STEPS = 20  # of a run, so that its time step divides its end

HEADER = "FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n"
FILES = {
    "system/blockMeshDict": """
scale 1;
vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 0.1) (1 0 0.1) (1 1 0.1) (0 1 0.1));
blocks (hex (0 1 2 3 4 5 6 7) ({side} {side} 1) simpleGrading (1 1 1));
edges ();
boundary
(
    lid {{ type wall; faces ((3 7 6 2)); }}
    walls {{ type wall; faces ((0 4 7 3) (2 6 5 1) (1 5 4 0)); }}
    sides {{ type empty; faces ((0 3 2 1) (4 5 6 7)); }}
);
mergePatchPairs ();
""",
    "system/controlDict": """
application icoFoam;
startFrom startTime; startTime 0; stopAt endTime; endTime {until!r}; deltaT {step!r};
writeControl timeStep; writeInterval {steps}; purgeWrite 1;
writeFormat ascii; writePrecision 10; writeCompression off; timeFormat general; timePrecision 10;
runTimeModifiable false;
""",
    "system/fvSchemes": """
ddtSchemes {{ default backward; }}
gradSchemes {{ default Gauss linear; }}
divSchemes {{ default none; div(phi,U) Gauss linear; }}
laplacianSchemes {{ default Gauss linear orthogonal; }}
interpolationSchemes {{ default linear; }}
snGradSchemes {{ default orthogonal; }}
""",
    "system/fvSolution": """
solvers
{{
    p {{ {pressure} tolerance 1e-6; relTol 0.05; }}
    pFinal {{ $p; relTol 0; }}
    U {{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-5; relTol 0; }}
}}
PISO {{ nCorrectors 2; nNonOrthogonalCorrectors 0; pRefCell 0; pRefValue 0; }}
""",
    "constant/transportProperties": "nu {viscosity!r};\n",
    "0/U": """
dimensions [0 1 -1 0 0 0 0];
internalField uniform (0 0 0);
boundaryField
{{
    lid {{ type fixedValue; value uniform (1 0 0); }}
    walls {{ type noSlip; }}
    sides {{ type empty; }}
}}
""",
    "0/p": """
dimensions [0 2 -2 0 0 0 0];
internalField uniform 0;
boundaryField
{{
    lid {{ type zeroGradient; }}
    walls {{ type zeroGradient; }}
    sides {{ type empty; }}
}}
""",
}
PRESSURE_SOLVERS = {
    "GAMG": "solver GAMG; smoother GaussSeidel;",  # the faster one from 32 cells a side on
    "PCG": "solver PCG; preconditioner DIC;",  # that of OpenFOAM's own cavity
}


def installed() -> bool:
    """True where the programs are."""
    return all(shutil.which(program) for program in PROGRAMS)


def _called(*command: str) -> str:
    """Call a program of OpenFOAM on one core; its output."""
    alone = {"WM_PROJECT_DIR": DEBIAN, **os.environ, "OMP_NUM_THREADS": "1"}
    done = subprocess.run(command, env=alone, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{command[0]} failed: {(done.stderr or done.stdout).strip()[-500:]}")
    return done.stdout


def version() -> str:
    """The version, as icoFoam says it."""
    found = re.search(r"OpenFOAM-\s*\(?([\w.]+)", _called("icoFoam", "-help"))
    return f"OpenFOAM {found[1] if found else 'of unknown version'}"


def steps_of(side: int, until: float, courant: float) -> int:
    """The number of steps to the end, the lid's speed times a step at most `courant` cells."""
    return max(NEEDED_STEPS, int(np.ceil(until * side / courant - 1e-9)))


def write_case(
    folder: Path, side: int, reynolds: float, until: float, courant: float = 1.0, pressure: str = "GAMG"
) -> int:
    """Write the case of a cavity with side^2 cells; the number of its steps."""
    steps = steps_of(side, until, courant)
    values = {
        "side": side,
        "viscosity": 1.0 / reynolds,
        "until": float(until),
        "step": until / steps,
        "steps": steps,
        "pressure": PRESSURE_SOLVERS[pressure],
    }
    for name, text in FILES.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        kind = {"U": "volVectorField", "p": "volScalarField"}.get(file.name, "dictionary")
        file.write_text(HEADER.format(kind=kind, name=file.name) + text.format(**values))
    return steps


def run(folder: Path) -> float:
    """Make the mesh and run the case; processor seconds of icoFoam, as it says itself."""
    _called("blockMesh", "-case", str(folder))
    return execution_time(_called("icoFoam", "-case", str(folder)))


def execution_time(said: str) -> float:
    """The last execution time that icoFoam printed, in seconds of the processor."""
    return float(re.findall(r"^ExecutionTime = ([\d.eE+-]+) s", said, re.MULTILINE)[-1])


def profiles(folder: Path, side: int, until: float, stations: Array) -> Lines:
    """u on x = 1/2 and v on y = 1/2 at the stations, from the cells at the last time.

    With an even number of cells the two columns beside the line are averaged; walls are stations too, and splines go
    through all of them.
    """
    last = max(
        (file for file in folder.iterdir() if re.fullmatch(r"[\d.e+-]+", file.name)), key=lambda f: float(f.name)
    )
    if abs(float(last.name) - until) > 1e-6 * until:
        raise SystemExit(f"icoFoam's last time is {last.name} and not {until:g}")
    return centrelines(read_velocities((last / "U").read_text(), side), stations)


def read_velocities(text: str, side: int) -> Array:
    """The velocities of the cells in a file of OpenFOAM, (side, side, 2), the first index along y."""
    body = re.search(rf"internalField\s+nonuniform\s+List<vector>\s+{side**2}\s*\((.*?)\)\s*;", text, re.DOTALL)
    if body is None:
        raise SystemExit(f"there are no velocities of {side} x {side} cells in the file of OpenFOAM")
    numbers = np.array(body[1].replace("(", " ").replace(")", " ").split(), dtype=np.float64)
    return numbers.reshape(side, side, 3)[:, :, :2]


def centrelines(velocities: Array, stations: Array) -> Lines:
    """Both centre-line profiles of cell values (side, side, 2), at stations."""
    side = len(velocities)
    middle = slice((side - 1) // 2, side // 2 + 1)
    where = np.concatenate(([0.0], (np.arange(side) + 0.5) / side, [1.0]))
    u = np.concatenate(([0.0], velocities[:, middle, 0].mean(axis=1), [1.0]))
    v = np.concatenate(([0.0], velocities[middle, :, 1].mean(axis=0), [0.0]))
    return {name: (stations, CubicSpline(where, values)(stations)) for name, values in (("u", u), ("v", v))}
