"""A run in plain words and numbers: what was computed, how finely, and what went on."""
import math

import numpy as np

from ..run import Run
from ..shapes import NotDrawable, Shape
from ..units import number, percent, quantity

_DIMENSIONS = {
    "axisymmetric": "axisymmetric (two coordinates)",
    "spherical": "spherical (one coordinate)",
    "plane": "plane (one coordinate)",
    1: "one-dimensional",
    2: "two-dimensional",
    3: "three-dimensional",
}
_KERNELS = {
    "wendland_c2": "Wendland's C2",
    "wendland_c4": "Wendland's C4",
    "wendland_c6": "Wendland's C6",
    "gaussian": "Gaussian",
    "cubic_spline": "cubic spline",
    "quintic_spline": "quintic spline",
}
_STATUS = {
    "done": ("finished", "good"),
    "stopped": ("stopped by the numerics", "bad"),
    "interrupted": ("interrupted", "warn"),
    "failed": ("failed", "bad"),
}


def status(run: Run) -> tuple[str, str]:
    """How the run ended, in words, and a class of colour."""
    if not run.summary:
        return "not finished", "warn"
    return _STATUS.get(str(run.summary.get("status")), (str(run.summary.get("status", "unknown")), "warn"))


def lead(run: Run) -> str:
    """One sentence: kind of scene, matter, end."""
    parts = [_DIMENSIONS.get(run.dimension, str(run.dimension)).capitalize()]
    planes = run.setting("symmetry.planes", [])
    if planes:
        parts.append(f"symmetric about {' and '.join(f'{p} = 0' for p in planes)}")
    counted = [
        (run.summary.get("particles"), "particles"),
        (run.summary.get("cells"), "cells" if run.is_on_a_line else "cells of structure"),
    ]
    matter = [f"{count:,} {what}" for count, what in counted if isinstance(count, int) and count]
    spacing = run.setting("resolution.spacing")
    if matter:
        parts.append(
            " and ".join(matter)
            + (f" at a spacing of {quantity(spacing, 'm')}" if spacing and matter[0].endswith("particles") else "")
        )
    end = run.summary.get("time_s") or (run.energy["time"][-1] if run.energy and "time" in run.energy else None)
    if end:
        parts.append(f"computed to {quantity(end, 's')}")
    return ", ".join(parts) + "."


def chips(run: Run) -> list[tuple[str, str, str]]:
    """The run at a glance: value, what it is, class of colour."""
    words, colour = status(run)
    found = [(words, "the run", colour)]
    summary = run.summary
    if isinstance(summary.get("wall_time_s"), (int, float)):
        threads = summary.get("threads", 1)
        found.append((duration(summary["wall_time_s"]), f"wall time, {threads} thread{'s' if threads != 1 else ''}", ""))
    for key, what in (("energy_error", "energy error at the end"), ("interface_energy_error", "energy error at the interface")):
        value = summary.get(key)
        if isinstance(value, (int, float)):
            found.append((percent(value, 3), what, "good" if abs(value) < 0.01 else "warn" if abs(value) < 0.05 else "bad"))
    warnings = len(summary.get("warnings", []) or [])
    found.append((number(warnings), "warning" if warnings == 1 else "warnings", "warn" if warnings else ""))
    return found


def duration(seconds: float) -> str:
    if seconds < 120:
        return f"{seconds:.3g} s"
    return f"{seconds / 60:.3g} min" if seconds < 7200 else f"{seconds / 3600:.3g} h"


# ------------------------------------------------------------------------------------------------ the scene


def shape_words(shape: dict) -> str:
    """A shape with its sizes."""
    try:
        return _shape_words(shape) + (", turned" if np.any(np.array(shape.get("rotate", 0.0))) else "")
    except (KeyError, TypeError, ValueError):
        return str(shape.get("type", "shape of unknown type"))


def _shape_words(shape: dict) -> str:
    kind = shape.get("type")
    length = lambda value: quantity(float(value), "m")
    if kind == "sphere":
        return f"sphere of radius {length(shape['radius'])}"
    if kind in ("cylinder", "rod"):
        return f"{kind} of radius {length(shape['radius'])}" + _along(shape)
    if kind in ("tube", "ring"):
        wall = shape["outer_radius"] - shape["inner_radius"]
        return f"{kind} of inner radius {length(shape['inner_radius'])} and wall {length(wall)}" + _along(shape)
    if kind == "cone":
        return f"cone of radii {length(shape['low_radius'])} and {length(shape['high_radius'])}" + _along(shape)
    if kind in ("box", "plate"):
        low, high = np.atleast_1d(shape["low"]), np.atleast_1d(shape["high"])
        return f"{kind} of {' × '.join(number(1e3 * float(b - a)) for a, b in zip(low, high))} mm"
    if kind == "ellipsoid":
        return f"ellipsoid with semi-axes of {' × '.join(number(1e3 * float(a)) for a in shape['semi_axes'])} mm"
    if kind in ("gmsh", "stl"):
        thickness = f", shells of {length(shape['thickness'])}" if "thickness" in shape else ""
        return f"from the file {str(shape.get('path') or shape.get('file') or '').rpartition('/')[2]}{thickness}"
    return str(kind or "without a shape")


def _along(shape: dict) -> str:
    if "low" not in shape or "high" not in shape:
        return ""
    return f", {quantity(float(shape['high']) - float(shape['low']), 'm')} long along {shape.get('axis', 'z')}"


def parts(run: Run) -> list[tuple[str, str]]:
    """Each body, structure, solid, obstacle and wall: its name, and its shape, material, state in words."""
    found = []
    for body in run.tables("bodies"):
        words = [shape_words(body.get("shape", {})), f"of {material_name(body)}"]
        mass = _mass(body)
        if mass:
            words.append(f"{quantity(mass, 'kg')} (whole)")
        if isinstance(body.get("pressure"), (int, float)):
            words.append(f"at {quantity(body['pressure'], 'Pa')}")
        if isinstance(body.get("burn"), dict):
            words.append(f"burn: {body['burn'].get('model', 'programmed')}")
        found.append((str(body.get("name", "body")), ", ".join(words)))
    for table in run.tables("structures") + run.tables("solids"):
        words = [shape_words(table.get("shape", {})), f"of {material_name(table)}"]
        if isinstance(table.get("cells"), dict):
            cells = table["cells"]
            words.append("cells: " + ", ".join(f"{count} {name}" for name, count in cells.items()))
        if np.any(np.array(table.get("velocity", 0.0))):
            words.append(f"at {quantity(float(np.linalg.norm(table['velocity'])), 'm/s')}")
        if table.get("wet"):
            words.append("wet: " + ", ".join(map(str, table["wet"])))
        found.append((str(table.get("name", "structure")), ", ".join(words)))
    for table in run.tables("obstacles"):
        found.append((str(table.get("name", "obstacle")), "rigid " + shape_words(table.get("shape", {}))))
    for table in run.tables("walls"):
        faces = table.get("faces", {})
        conditions = (
            ", ".join(f"{face} {str(kind).replace('_', ' ')}" for face, kind in faces.items()) if isinstance(faces, dict) else ""
        )
        found.append(
            (
                str(table.get("name", "wall")),
                f"rigid wall: {shape_words(table.get('shape', {}))}" + (f" ({conditions})" if conditions else ""),
            )
        )
    return found


def material_name(table: dict) -> str:
    material = table.get("material", {})
    return (
        str(material.get("name") or material.get("law") or "a material of its own")
        if isinstance(material, dict)
        else str(material)
    )


def _mass(body: dict) -> float | None:
    """Mass of a charge that is a sphere or a cylinder, from its density; larger bodies are cut by others."""
    shape, material = body.get("shape", {}), body.get("material", {})
    density = body.get("density") or (material.get("rho0") if isinstance(material, dict) else None)
    if "burn" not in body or not isinstance(density, (int, float)):
        return None
    if shape.get("type") == "sphere":
        return density * 4 / 3 * math.pi * float(shape["radius"]) ** 3
    if shape.get("type") == "cylinder" and "low" in shape:
        return density * math.pi * float(shape["radius"]) ** 2 * (float(shape["high"]) - float(shape["low"]))
    return None


def materials(run: Run) -> list[tuple[dict, list[str]]]:
    """Each material set with the names of what is made of it."""
    found: list[tuple[dict, list[str]]] = []
    for table in run.tables("bodies") + run.tables("structures") + run.tables("solids"):
        material = table.get("material")
        if not isinstance(material, dict):
            continue
        for known, users in found:
            if known == material:
                users.append(str(table.get("name", "")))
                break
        else:
            found.append((material, [str(table.get("name", ""))]))
    return found


def constants(material: dict) -> list[tuple[str, str]]:
    """Numbers and laws of a material as names and texts."""
    found = []
    for key, value in material.items():
        if isinstance(value, dict):
            found += [(f"{key}: {name}", text) for name, text in constants(value)]
        elif key not in ("name", "source") and isinstance(value, (int, float, str)):
            found.append((key, f"{value:.6g}" if isinstance(value, float) else str(value)))
    return found


# ------------------------------------------------------------------------------------------------ resolution


def resolution(run: Run) -> list[tuple[str, str]]:
    """How finely everything is resolved: what, and by how much."""
    rows = []
    spacing = run.setting("resolution.spacing")
    if run.is_on_a_line:
        rows = [("spacing at the start", quantity(spacing, "m"))] if isinstance(spacing, (int, float)) else []
        names = (("particles", "particles"), ("cells", "cells at the end"), ("steps", "steps"))
        return rows + [(what, f"{run.summary[key]:,}") for key, what in names if run.summary.get(key)]
    if isinstance(spacing, (int, float)) and spacing > 0:
        kernel, eta = str(run.setting("scheme.kernel", "wendland_c2")), run.setting("scheme.eta", 1.5)
        rows.append(("spacing of particles", quantity(spacing, "m")))
        if run.tables("bodies"):
            rows.append(("kernel", f"{_KERNELS.get(kernel, kernel)}, smoothing length {number(eta)} spacings"))
        rows += _charge_rows(run, spacing)
    rows += _standoffs(run, spacing)
    for table in run.tables("structures"):
        rows += _wall_rows(table, spacing)
    for table in run.tables("solids"):
        own = table.get("spacing", spacing)
        if isinstance(own, (int, float)):
            rows.append((f"spacing of '{table.get('name', 'solid')}'", quantity(own, "m")))
    for key, what in (
        ("particles", "moving particles"),
        ("wall_particles", "particles of walls and images"),
        ("cells", "cells of structure"),
        ("steps", "steps"),
    ):
        value = run.summary.get(key)
        if isinstance(value, int) and value:
            rows.append((what, f"{value:,}"))
    return rows


def _charge_rows(run: Run, spacing: float) -> list[tuple[str, str]]:
    rows = []
    for body in run.tables("bodies"):
        shape, name = body.get("shape", {}), body.get("name", "body")
        if not isinstance(shape, dict) or shape.get("type") != "sphere" or body.get("variable_h") is not True:
            continue
        rows.append(
            (f"across '{name}' at the start", f"{number(2 * float(shape['radius']) / spacing, 3)} spacings in its diameter")
        )
        start = run.bodies.get(f"{name}.radius") if run.bodies else None
        if run.setting("start.kind") == "spherical" and start is not None:
            rows.append(
                (
                    f"across '{name}' when particles take over",
                    f"{number(2 * float(start[0]) / spacing, 3)} spacings, at {quantity(float(run.bodies['time'][0]), 's')}; "
                    "until then it is computed in one dimension",
                )
            )
    return rows


def _standoffs(run: Run, spacing: float | None) -> list[tuple[str, str]]:
    """From the surface of each round charge or bubble to structures, solids, obstacles and walls, where these are simple shapes."""
    rows = []
    for body in run.tables("bodies"):
        ball = body.get("shape", {})
        if body.get("variable_h") is not True or ball.get("type") != "sphere":
            continue
        middle = np.resize(np.array(ball.get("center", [0.0, 0.0, 0.0]), dtype=float), (1, 3))
        for table in [each for key in ("structures", "solids", "obstacles", "walls") for each in run.tables(key)]:
            try:
                distance = abs(float(Shape(table.get("shape", {}), run.dimension).level(middle)[0])) - float(ball["radius"])
            except NotDrawable:
                continue
            words = quantity(distance, "m") + (f", {number(distance / spacing, 3)} spacings" if spacing else "")
            rows.append((f"from '{body.get('name', 'body')}' to '{table.get('name', 'structure')}'", words))
    return rows


def _wall_rows(table: dict, spacing: float | None) -> list[tuple[str, str]]:
    shape, cells = table.get("shape", {}), table.get("cells", {})
    name = table.get("name", "structure")
    thickness = None
    if shape.get("type") in ("tube", "ring"):
        thickness = float(shape["outer_radius"]) - float(shape["inner_radius"])
    elif shape.get("type") == "plate":
        thickness = float(np.min(np.array(shape["high"]) - np.array(shape["low"])))
    elif "thickness" in shape:
        thickness = float(shape["thickness"])
    words = []
    if isinstance(cells, dict) and "through" in cells:
        words.append(f"{cells['through']} cells")
    if thickness:
        words.append(
            f"{quantity(thickness, 'm')} thick" + (f", {number(thickness / spacing, 3)} spacings of the fluid" if spacing else "")
        )
    return [(f"through '{name}'", ", ".join(words))] if words else []


# ------------------------------------------------------------------------------------------------ what went on

_CLAMPS = {
    "density": "a density that would have changed by more than a factor of e in half a step",
    "smoothing": "a smoothing length at its bound (scheme.h_low or h_high); usual in gas that spreads far",
    "filling": "a filling of space at its lower bound of 1/2; beside free surfaces and in gas that spreads far",
    "energy": "gas whose energy fell below zero",
}


def clamps(run: Run) -> list[str]:
    """How often each bound acted, as a share of all particle updates."""
    updates = run.summary.get("particle_updates") or 0
    said = []
    for name, count in (run.summary.get("clamps") or {}).items():
        if isinstance(count, int) and count:
            share = f" ({number(100 * count / updates, 2)} % of all particle updates)" if updates else ""
            said.append(f"{count:,} times{share}: {_CLAMPS.get(name, name)}.")
    return said


def step_limits(run: Run) -> list[str]:
    """What set the steps: one sentence, or none where the record does not say."""
    counts = {name: count for name, count in (run.summary.get("step_limits") or {}).items() if isinstance(count, int) and count > 0}
    total = sum(counts.values())
    if not total:
        return []
    shares = [f"{name} {number(100 * count / total, 3)} %" for name, count in counts.items()]
    return ["Steps were set by: " + ", ".join(shares) + "."]


def trust(run: Run) -> list[str]:
    """What the ledgers say, in words."""
    said = []
    if run.energy is not None and "error" in run.energy and len(run.energy["error"]):
        errors = run.energy["error"]
        said.append(
            f"The energy balance is off by {percent(float(errors[-1]), 3)} at the end, and by {percent(float(errors[np.abs(errors).argmax()]), 3)} at most."
        )
    for key, what in (
        ("mass_error", "Mass"),
        ("momentum_error", "Momentum"),
        ("interface_energy_error", "What the interface gives and receives in energy"),
        ("interface_impulse_error", "What the interface gives and receives in impulse"),
    ):
        value = run.summary.get(key)
        if isinstance(value, (int, float)):
            said.append(f"{what} is off by {number(100 * value, 2)} %." if abs(value) > 1e-10 else f"{what} is kept to rounding.")
    return said
