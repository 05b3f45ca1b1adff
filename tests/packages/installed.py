#!/usr/bin/python3
"""What is installed works away from the source tree: the program with its data, and the libraries in another project.

Usage: installed.py install BUILD PREFIX     lays the build down in PREFIX, by way of another folder: what is installed can be moved.
                                             Compares the versions that the project states, too
       installed.py program PREFIX VERSION   the program there, in an empty environment
       installed.py libraries PREFIX BUILD   the project beside this file is configured, built and run with what is there

Each says what is wrong and ends with 1.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
SCENE = ["al_tube_fem/experiment.toml", "-P", "resolution.spacing=2 mm", "-P", "end_time=40 us"]  # has a mesh of deal.II


def fail(message):
    sys.exit(f"installed.py: {message}")


def output_of(words, folder, environment=None, code=0):
    """What a command prints, errors included; it must end with `code`."""
    finished = subprocess.run([str(word) for word in words], cwd=folder, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
    if finished.returncode != code:
        fail(f"{' '.join(map(str, words))} ended with {finished.returncode}, not {code}:\n{finished.stdout}")
    return finished.stdout


def require(condition, message):
    if not condition:
        fail(message)


# ------------------------------------------------------------------------------------------------------- versions

def versions():
    stated = {name: re.search(pattern, (SOURCE / name).read_text(encoding="utf-8"), re.M) for name, pattern in
              [("CMakeLists.txt", r"^project\(undex VERSION (\S+) "), ("CHANGELOG.md", r"^## \[([\d.]+)\] - \d{4}-\d\d-\d\d$"),
               ("CITATION.cff", r"^version: (\S+)$")]}
    stated = {name: found and found[1] for name, found in stated.items()}
    require(None not in stated.values() and len(set(stated.values())) == 1, f"the version differs: {stated}")


# -------------------------------------------------------------------------------------------------------- install

def install(build, prefix):
    versions()
    shutil.rmtree(prefix, ignore_errors=True)
    first = prefix.with_name(prefix.name + "_first")
    shutil.rmtree(first, ignore_errors=True)
    output_of(["cmake", "--install", build, "--prefix", first], build)
    first.rename(prefix)
    for name in ["bin/undex", "lib/undex/libundex_meshes.so", "lib/cmake/undex/undexConfig.cmake",
                 "share/undex/cases/al_tube_fem/case.toml", "share/undex/cases/al_tube_fem/reference/displacement.csv",
                 "share/undex/cases/free_field/study.toml", "share/undex/docs/tutorial.md", "share/doc/undex/README.md",
                 "share/doc/undex/LICENSE", "share/doc/undex/CHANGELOG.md",
                 "share/man/man1/undex.1", "share/bash-completion/completions/undex", "share/zsh/site-functions/_undex",
                 "share/fish/vendor_completions.d/undex.fish"]:
        require((prefix / name).is_file() and (prefix / name).stat().st_size > 100, f"{name} is not installed")
    for path in (SOURCE / "core").glob("*.hpp"):
        require((prefix / "include/undex/core" / path.name).is_file(), f"core/{path.name} is not installed")
    for path in (SOURCE / "cases").rglob("*.toml"):
        name = path.relative_to(SOURCE)
        require("out" in name.parts or (prefix / "share/undex" / name).is_file(), f"{name} is not installed")
    for path in prefix.rglob("*.cmake"):
        for folder in (SOURCE, build, first):
            require(str(folder) not in path.read_text(), f"{path} names {folder}, where nothing may be looked for")


# -------------------------------------------------------------------------------------------------------- program

def program(prefix, version):
    undex = prefix / "bin/undex"
    with tempfile.TemporaryDirectory() as folder:
        said = output_of([undex, "version"], folder, {})
        require(said.startswith(f"undex {version} ") or said.startswith(f"undex {version},"), f"undex version says: {said}")
        listed = re.findall(r"^\s+(\S*/cases/\S+)$", output_of([undex, "list"], folder, {}), re.M)
        require(len(listed) == len(list((SOURCE / "cases").glob("*/case.toml"))), f"undex list shows {len(listed)} folders")
        for path in listed:
            require(Path(path).is_relative_to(prefix), f"undex list shows {path}, which is not below {prefix}")

        output_of([undex, "new", "tube", "of_page"], folder, {})
        output_of([undex, "check", "of_page"], folder, {})
        output_of([undex, "new", "rigid_cylinder", "of_case"], folder, {})
        require((Path(folder) / "of_case/reference/metrics.csv").is_file(), "undex new rigid_cylinder copies no reference")

        run = [undex, "run", prefix / "share/undex/cases" / SCENE[0], *SCENE[1:], "-j", "1"]
        output_of([*run, "-o", "tube"], folder, {})
        summary = json.loads((Path(folder) / "tube/summary.json").read_text())
        require(summary["status"] == "done" and summary["metrics"], f"the tube's summary.json: {summary}")
        if (SOURCE / "post").is_dir():
            output_of([undex, "report", "tube", "-o", "tube.html"], folder, {})
            require("</html>" in (Path(folder) / "tube.html").read_text(encoding="utf-8"), "the report has no end")

        # The library of meshes is the installed one: without it there is no mesh.
        library = prefix / "lib/undex/libundex_meshes.so"
        hidden = library.with_suffix(".hidden")
        library.rename(hidden)
        try:
            said = output_of([*run, "-o", "without"], folder, {}, code=1)
        finally:
            hidden.rename(library)
        require("libundex_meshes.so" in said, f"without the library of meshes: {said}")
    output_of([sys.executable, SOURCE / "tests/site/check_links.py", "pages", prefix / "share/undex"], prefix)


# ------------------------------------------------------------------------------------------------------ libraries

def libraries(prefix, build):
    shutil.rmtree(build, ignore_errors=True)
    output_of(["cmake", "-G", "Ninja", "-S", HERE / "consumer", "-B", build, "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_PREFIX_PATH={prefix}"],
              HERE)
    for command in json.loads((build / "compile_commands.json").read_text()):
        words = command["command"].split()
        require(f"{prefix}/include/undex" in words, f"the installed headers are not used: {command['command']}")
        for word in words:
            if word.startswith(("-W", "-f")) and word != "-fopenmp" or "pch" in word or word.startswith("-DUNDEX"):
                fail(f"{word} of this build is handed to other projects")
    output_of(["cmake", "--build", build], build)

    said = dict(line.rsplit(" ", 1) for line in output_of([build / "laws"], build, {}).splitlines())
    tait = 3.31e8 * (1.1**7.15 - 1) + 1e5
    require(abs(float(said["pressure"]) / tait - 1) < 1e-6, f"Tait's pressure is {said['pressure']}, not {tait}")
    require(said["particles"] == "6000", f"a box of 30 x 20 x 10 cells has {said['particles']} particles")

    said = dict(line.rsplit(" ", 1) for line in output_of([build / "scene", HERE / "consumer/plate.toml", "out"], build, {}).splitlines())
    # A quarter of 20 x 20 x 20 mm of water in cells of 2 mm, and of 20 x 20 x 4 mm of plate.
    require((said["status"], said["particles"], said["cells"]) == ("done", "250", "50"), f"the scene's record: {said}")
    require(abs(float(said["time"]) - 5e-6) < 1e-12, f"the scene ended at {said['time']}")
    require((build / "out/evidence.h5").is_file(), "the scene left no evidence.h5")


def main():
    words = sys.argv[1:]
    if len(words) != 3 or words[0] not in ("install", "program", "libraries"):
        sys.exit(__doc__)
    if words[0] == "program":
        program(Path(words[1]).resolve(), words[2])
    else:
        {"install": install, "libraries": libraries}[words[0]](Path(words[1]).resolve(), Path(words[2]).resolve())


if __name__ == "__main__":
    main()
