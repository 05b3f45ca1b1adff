#!/usr/bin/env python3
"""Fails on an include that the architecture forbids, and on paths of somebody's machine.

The graph: app -> study -> judge -> run -> coupling -> {sph_fluid, fem_structure} -> materials -> core; exact -> materials;
output -> core; scene sees the settings of the modules that it fills, never a solver. deal.II stays inside fem_structure, out of its public headers.

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
    "sph_solid": ["core", "materials", "sph_fluid"],
    "coupling": ["core", "materials", "sph_fluid", "sph_solid", "fem_structure"],
    "scene": ["core", "materials", "sph_fluid/settings.hpp", "sph_solid/settings.hpp", "fem_structure/settings.hpp",
              "coupling/settings.hpp"],
    "output": ["core"],
    "run": ["core", "materials", "exact", "sph_fluid", "sph_solid", "fem_structure", "coupling", "scene", "output"],
    "judge": ["core", "materials", "exact", "sph_fluid/settings.hpp", "fem_structure/settings.hpp", "scene", "output", "run"],
    "study": ["core", "scene", "output", "judge"],
    "app": MODULES,
}
# Headers of fem_structure that other modules see; what they include must be free of deal.II too.
PUBLIC_OF_FEM = ["structure.hpp", "settings.hpp"]

# Rooms inside a module, lowest first; "" is the module's own folder. A room includes itself and those below it.
ROOMS = {"sph_fluid": ["pairs", "schemes", "", "walls", "water"]}

# Libraries that one module keeps to itself.
LIBRARY_OWNERS = {
    "deal.II/": ["fem_structure"],
    "hdf5.h": ["output"],
    "H5": ["output"],
    "toml++/": ["scene"],
    "CLI/": ["app"],
}

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.M)
SOURCES = {".hpp", ".cpp", ".h", ".cc", ".inc"}
TEXTS = SOURCES | {".md", ".toml", ".txt", ".cmake", ".py", ".sh", ".json", ".csv", ".yml", ".yaml", ""}
FOREIGN = re.compile(r"(?<![\w.])/(?:work|home|root|Users|tmp/build)[/\w]*|(?<![\w.-])shared/[\w.]+")
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


def allowed(module, target):
    head = target.split("/")[0]
    return head == module or head in MAY_INCLUDE[module] or target in MAY_INCLUDE[module]


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


def room_of(path):
    """Place among its module's rooms of a file that is in one of them, else None."""
    parts = pathlib.PurePosixPath(path).parts
    rooms = ROOMS.get(parts[0], [])
    room = parts[1] if len(parts) > 2 else ""
    return rooms.index(room) if room in rooms else None


def check_rooms(root, relative, findings):
    module = relative.parts[0]
    if module not in ROOMS:
        return
    here = room_of(relative.as_posix())
    if here is None:
        findings.append(f"{relative}: {relative.parts[1]}/ is none of the rooms of {module}")
        return
    for quoted, target in includes(root / relative):
        there = room_of(target) if quoted and target.split("/")[0] == module else None
        if there is not None and there > here:
            findings.append(f"{relative}: includes {target}, which stands above it")


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


def check(root):
    findings = []
    counted = 0
    for relative in files(root):
        if relative.parts[0] in MODULES and relative.suffix in SOURCES:
            counted += 1
            check_module(root, relative, findings)
            check_rooms(root, relative, findings)
        check_paths(root, relative, findings)
    check_deal_ii_is_private(root, findings)
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
        "app/a.cpp": ('#include "run.hpp"', "without its module"),
        "sph_fluid/pairs/a.hpp": ('#include "sph_fluid/schemes/b.hpp"', "stands above it"),
        "sph_fluid/settings.hpp": ('#include "sph_fluid/walls/b.hpp"', "stands above it"),
        "sph_fluid/walls/a.cpp": ('#include "sph_fluid/water/fluid.hpp"', "stands above it"),
        "sph_fluid/attic/a.cpp": ("", "none of the rooms"),
        "run/a.cpp": ('#include "judge/judge.hpp"', "run must not include"),
        "judge/a.cpp": ('#include "study/study.hpp"', "judge must not include"),
        "judge/b.cpp": ('#include "sph_fluid/water/fluid.hpp"', "judge must not include"),
        "study/a.cpp": ('#include "run/run.hpp"', "study must not include"),
        "study/b.cpp": ('#include "app/version.hpp"', "study must not include"),
        "scene/b.cpp": ('#include "judge/judge.hpp"', "scene must not include"),
    }
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        sound = {
            "coupling/good.cpp": '#include "sph_fluid/water/fluid.hpp"\n#include "fem_structure/structure.hpp"\n#include <vector>\n',
            "sph_fluid/water/fluid.hpp": '#include "core/vector.hpp"\n',
            "scene/good.cpp": '#include "sph_fluid/settings.hpp"\n',
            "sph_fluid/settings.hpp": "",
            "fem_structure/structure.hpp": '#include "core/vector.hpp"\n',
            "fem_structure/private.hpp": "#include <deal.II/grid/tria.h>\n",
            "core/vector.hpp": "#include <Eigen/Core>\n",
            "exact/good.cpp": '#include "core/vector.hpp"\n',
            "app/good.cpp": '#include "exact/riemann.hpp"\n',
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
