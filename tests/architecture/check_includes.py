#!/usr/bin/env python3
"""Fails on an include that the architecture forbids, on paths of somebody's machine, and on named files that do not exist.

The graph is MAY_INCLUDE: app -> study -> judge -> run -> {coupling, fem_structure}, coupling -> sph_solid -> sph_fluid, all -> materials ->
core; within sph_fluid water -> walls -> settings -> schemes -> pairs. scene sees the settings of the modules that it fills, never a
solver. deal.II stays inside fem_structure, out of its public headers.

    check_includes.py ROOT         checks the project at ROOT; exit code 1 and one line per finding
    check_includes.py --self-test  shows the check one example of each mistake
"""
import pathlib
import re
import sys
import tempfile

MODULES = ["core", "materials", "exact", "sph_fluid", "sph_solid", "fem_structure", "coupling", "scene", "output", "run",
           "judge", "study", "app"]

# What each module may include besides its own headers: a module, or single headers of it.
MAY_INCLUDE = {
    "core": [],
    "materials": ["core"],
    "exact": ["core", "materials"],
    "sph_fluid": ["core", "materials"],
    "fem_structure": ["core", "materials"],
    "sph_solid": ["core", "materials", "sph_fluid/pairs", "sph_fluid/lattice.hpp", "sph_fluid/settings.hpp",
                  "sph_fluid/walls/moving_walls.hpp"],
    "coupling": ["core", "sph_fluid/water/fluid.hpp", "sph_fluid/walls/moving_walls.hpp", "sph_fluid/walls/slip_faces.hpp",
                 "sph_fluid/lattice.hpp", "sph_solid/solids.hpp"],
    "scene": ["core", "materials", "sph_fluid/settings.hpp", "sph_solid/settings.hpp", "fem_structure/settings.hpp",
              "coupling/settings.hpp"],
    "output": ["core"],
    "run": ["core", "exact", "sph_fluid/water/fluid.hpp", "sph_fluid/walls/lattice_warnings.hpp",
            "sph_fluid/walls/slip_faces.hpp", "sph_fluid/lattice.hpp",
            "sph_solid/solids.hpp", "fem_structure/structure.hpp", "coupling", "scene", "output"],
    "judge": ["core", "exact", "sph_fluid/settings.hpp", "scene", "output", "run"],
    "study": ["core", "scene", "output", "judge"],
    "app": ["core", "materials", "scene", "output", "run", "judge", "study", "sph_fluid/pairs/cpu_level.hpp"],
}
# Rooms within a module: what the files of each may include of the project, themselves aside.
ROOMS = {
    "sph_fluid/pairs": [],
    "sph_fluid/schemes": ["sph_fluid/pairs"],
    "sph_fluid/walls": ["core", "sph_fluid/pairs", "sph_fluid/settings.hpp", "sph_fluid/lattice.hpp", "sph_fluid/lattice_grid.hpp"],
    "sph_fluid/water": ["core", "sph_fluid"],
}
# Files at the top of a module that has rooms.
TOPS = {"sph_fluid": ["core", "materials", "sph_fluid/pairs", "sph_fluid/schemes/table.hpp"]}
# What is compiled once per instruction set, and all that it includes, may know of libraries only what instantiates no template:
# the linker could keep the copy of the highest instruction set for everybody.
PER_LEVEL = ["sph_fluid/pairs/cluster_work.hpp", "sph_fluid/schemes/*.hpp", "sph_solid/solid_schemes.hpp", "sph_solid/solid_loop.cpp"]
PER_LEVEL_LIBRARIES = {"cmath", "cstddef", "cstdint", "immintrin.h", "numbers", "omp.h", "utility"}
# Headers of fem_structure that other modules see; what they include must be free of deal.II too.
PUBLIC_OF_FEM = ["structure.hpp", "settings.hpp"]

# Libraries that one module keeps to itself.
LIBRARY_OWNERS = {
    "deal.II/": ["fem_structure"],
    "hdf5.h": ["output"],
    "H5": ["output"],
    "toml++/": ["core"],
    "CLI/": ["app"],
    "udunits2.h": ["scene"],
    "xxhash.h": ["output"],
}

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.M)
SOURCES = {".hpp", ".cpp", ".h", ".cc", ".inc"}
TEXTS = SOURCES | {".md", ".toml", ".txt", ".cmake", ".py", ".sh", ".json", ".csv", ".yml", ".yaml", ""}
FOREIGN = re.compile(r"(?<![\w.])/(?:work|home|root|Users|tmp/build)[/\w]*|(?<![\w.-])shared/[\w.]+")
NAMED_FILE = re.compile(r"(?<![\w/.-])([a-z_0-9]+(?:/[a-z_0-9]+)*\.(?:hpp|cpp))\b")
SKIPPED = {".git", "build", "out", "__pycache__"}  # what git ignores too
HERE = pathlib.PurePosixPath("tests/architecture/check_includes.py")


def files(root):
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        if path.is_file() and not SKIPPED.intersection(relative.parts):
            yield relative


def includes(path):
    text = path.read_text(encoding="utf-8", errors="replace")
    return [(quote == '"', target) for quote, target in INCLUDE.findall(text)]


def listed(target, these):
    """Is a header, its room or its module among these?"""
    return any(str(each) in these for each in [pathlib.PurePosixPath(target), *pathlib.PurePosixPath(target).parents])


def allowed(module, target):
    return target.split("/")[0] == module or listed(target, MAY_INCLUDE[module])


def room_of(relative):
    return str(pathlib.PurePosixPath(*relative.parts[:2]))


def check_room(root, relative, findings):
    module = relative.parts[0]
    if room_of(relative) in ROOMS:
        room, may = room_of(relative), ROOMS[room_of(relative)]
    elif module in TOPS:
        room, may = module, TOPS[module]
    else:
        return
    for quoted, target in includes(root / relative):
        own = str(pathlib.PurePosixPath(target).parent) == room
        if quoted and target.split("/")[0] in MODULES and not own and not listed(target, may):
            findings.append(f"{relative}: {room} must not include {target}")


def check_per_level(root, findings):
    waiting = sorted({str(path.relative_to(root)) for pattern in PER_LEVEL for path in root.glob(pattern)})
    seen = set(waiting)
    for name in waiting:  # grows while it is walked
        for quoted, target in includes(root / name):
            if not quoted and target not in PER_LEVEL_LIBRARIES:
                findings.append(f"{name}: <{target}> may instantiate templates in what is compiled per instruction set")
            elif quoted and target not in seen and (root / target).is_file():
                seen.add(target)
                waiting.append(target)


def check_module(root, relative, findings):
    module = relative.parts[0]
    for quoted, target in includes(root / relative):
        if quoted and target.split("/")[0] in MODULES and not allowed(module, target):
            findings.append(f"{relative}: {module} must not include {target}")
        if quoted and "/" not in target:
            findings.append(f'{relative}: "{target}" is included without its module')
        if quoted and target.split("/")[0] in MODULES and not (root / target).is_file():
            findings.append(f"{relative}: {target} does not exist")
        for library, owners in LIBRARY_OWNERS.items():
            if not quoted and target.startswith(library) and module not in owners:
                findings.append(f"{relative}: <{target}> belongs to {' and '.join(owners)} alone")


def check_deal_ii_is_private(root, findings):
    """No public header of fem_structure may reach deal.II, over whatever other headers."""
    waiting = [f"fem_structure/{name}" for name in PUBLIC_OF_FEM]
    seen = set(waiting)
    for name in waiting:  # grows while it is walked
        if not (root / name).is_file():
            continue
        for quoted, target in includes(root / name):
            if target.startswith("deal.II/"):
                findings.append(f"{name}: deal.II is seen through the public header of fem_structure")
            elif quoted and target not in seen:
                seen.add(target)
                waiting.append(target)


def check_paths(root, relative, findings):
    if relative.suffix not in TEXTS or pathlib.PurePosixPath(relative) == HERE:
        return
    text = (root / relative).read_text(encoding="utf-8", errors="replace")
    for found in FOREIGN.finditer(text):
        line = text.count("\n", 0, found.start()) + 1
        findings.append(f"{relative}:{line}: mentions {found.group(0)}, a path outside the project")


def check_named_files(root, relative, names, findings):
    """A C++ file that a text names is there, in the folder that it says; <name>.hpp and the like stand for any."""
    if relative.suffix not in TEXTS or pathlib.PurePosixPath(relative) == HERE:
        return
    for number, line in enumerate((root / relative).read_text(encoding="utf-8", errors="replace").splitlines(), 1):
        for named in NAMED_FILE.findall(line) if "<" not in line and ".cpp.in" not in line else []:
            if not any(each == named or each.endswith("/" + named) for each in names):
                findings.append(f"{relative}:{number}: names {named}, which does not exist")


def check(root):
    findings = []
    counted = 0
    names = [relative.as_posix() for relative in files(root)]
    for relative in files(root):
        if relative.parts[0] in MODULES and relative.suffix in SOURCES:
            counted += 1
            check_module(root, relative, findings)
            check_room(root, relative, findings)
        check_paths(root, relative, findings)
        check_named_files(root, relative, names, findings)
    check_deal_ii_is_private(root, findings)
    check_per_level(root, findings)
    if counted == 0:
        findings.append(f"{root}: no sources found, nothing was checked")
    return findings


def self_test():
    mistakes = {
        "core/a.hpp": ('#include "materials/b.hpp"', "core must not include"),
        "materials/a.hpp": ('# include "sph_fluid/b.hpp"', "materials must not include"),
        "sph_fluid/a.cpp": ('#include "fem_structure/structure.hpp"', "sph_fluid must not include"),
        "fem_structure/a.cpp": ('#include "sph_fluid/water/fluid.hpp"', "fem_structure must not include"),
        "output/a.cpp": ('#include "sph_fluid/water/fluid.hpp"', "output must not include"),
        "exact/a.cpp": ('#include "sph_fluid/water/fluid.hpp"', "exact must not include"),
        "scene/a.cpp": ('#include "sph_fluid/water/fluid.hpp"', "scene must not include"),
        "coupling/a.cpp": ("#include <deal.II/grid/tria.h>", "belongs to fem_structure"),
        "fem_structure/structure.hpp": ('#include "fem_structure/private.hpp"', "deal.II is seen"),
        "docs/a.md": ("see /" + "home/me/notes", "a path outside"),
        "docs/b.md": ("see `core/none.hpp`", "does not exist"),
        "app/a.cpp": ('#include "run.hpp"', "without its module"),
        "run/a.cpp": ('#include "judge/judge.hpp"', "run must not include"),
        "judge/a.cpp": ('#include "study/study.hpp"', "judge must not include"),
        "judge/b.cpp": ('#include "sph_fluid/water/fluid.hpp"', "judge must not include"),
        "study/a.cpp": ('#include "run/run.hpp"', "study must not include"),
        "study/b.cpp": ('#include "app/version.hpp"', "study must not include"),
        "scene/b.cpp": ('#include "judge/judge.hpp"', "scene must not include"),
        "app/b.cpp": ('#include "sph_fluid/water/fluid.hpp"', "app must not include"),
        "coupling/c.cpp": ('#include "fem_structure/structure.hpp"', "coupling must not include"),
        "coupling/b.cpp": ('#include "sph_fluid/water/water.hpp"', "coupling must not include"),
        "sph_solid/a.cpp": ('#include "sph_fluid/water/fluid.hpp"', "sph_solid must not include"),
        "sph_fluid/pairs/a.hpp": ('#include "core/vector.hpp"', "sph_fluid/pairs must not include"),
        "sph_fluid/schemes/a.hpp": ('#include "sph_fluid/settings.hpp"', "sph_fluid/schemes must not include"),
        "sph_fluid/walls/a.cpp": ('#include "sph_fluid/water/fluid.hpp"', "sph_fluid/walls must not include"),
        "sph_fluid/walls/b.cpp": ('#include "sph_fluid/schemes/loops.hpp"', "sph_fluid/walls must not include"),
        "sph_fluid/b.cpp": ('#include "sph_fluid/walls/particles.hpp"', "sph_fluid must not include"),
        "sph_fluid/schemes/b.hpp": ("#include <vector>", "compiled per instruction set"),
        "sph_fluid/pairs/cluster_work.hpp": ('#include "sph_fluid/pairs/list.hpp"', "compiled per instruction set"),
    }
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        sound = {
            "coupling/good.cpp": '#include "sph_fluid/water/fluid.hpp"\n#include <vector>\n',
            "run/good.cpp": '#include "fem_structure/structure.hpp"\n',
            "sph_fluid/water/fluid.hpp": '#include "core/vector.hpp"\n#include "sph_fluid/walls/particles.hpp"\n',
            "sph_fluid/water/water.hpp": "",
            "sph_fluid/walls/particles.hpp": '#include "sph_fluid/pairs/list.hpp"\n',
            "sph_fluid/schemes/loops.hpp": "#include <cstddef>\n",
            "sph_fluid/pairs/list.hpp": "#include <vector>\n",
            "scene/good.cpp": '#include "sph_fluid/settings.hpp"\n',
            "sph_fluid/settings.hpp": "",
            "fem_structure/structure.hpp": '#include "core/vector.hpp"\n',
            "fem_structure/private.hpp": "#include <deal.II/grid/tria.h>\n",
            "core/vector.hpp": "#include <Eigen/Core>\n",
            "exact/good.cpp": '#include "core/vector.hpp"\n',
            "app/good.cpp": '#include "core/vector.hpp"\n',
            "exact/riemann.hpp": "",
        }
        for name, text in sound.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        if check(root):
            failed.append(f"sound sources are refused: {check(root)}")
        for name, (text, wanted) in mistakes.items():
            path = root / name
            before = path.read_text() if path.exists() else None
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text + "\n")
            if not any(wanted in finding for finding in check(root)):
                failed.append(f"{name} with '{text}' is accepted")
            path.write_text(before) if before is not None else path.unlink()
    return failed


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    findings = self_test() if sys.argv[1] == "--self-test" else check(pathlib.Path(sys.argv[1]))
    print("\n".join(findings) if findings else "nothing to complain about")
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    main()
