"""The command line of the package: pictures and reports of what undex has left.

    python3 -m undex_post plot RUN...                 pictures/*.png in the folder of each run, study or comparison
    python3 -m undex_post report RUN... [-o FILE]     one HTML file
"""
import argparse
import sys
from pathlib import Path

PACKAGES = "python3-numpy python3-h5py python3-matplotlib"
DONE, FAILED, WRONG = 0, 1, 2  # exit codes, as those of undex


def main(arguments: list[str] | None = None) -> int:
    """Runs a command and returns its exit code: 2 where the folders or options are wrong, 1 where something is missing."""
    options = _parser().parse_args(arguments)
    try:
        import h5py  # noqa: F401
        import matplotlib  # noqa: F401
        import numpy  # noqa: F401
    except ImportError as error:
        return _said(
            f"{error}: reports and pictures need it: apt-get install {PACKAGES} libjs-dygraphs, and Debian's own Python "
            f"(this is {sys.executable})",
            FAILED,
        )
    from .errors import Missing

    try:
        return _plot(options) if options.command == "plot" else _report(options)
    except Missing as error:
        return _said(str(error), FAILED if "apt-get" in str(error) else WRONG)
    except OSError as error:
        return _said(f"{error.filename or ''}: {error.strerror or error}".removeprefix(": "), FAILED)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="undex_post", description="Pictures and reports of what undex has left.")
    commands = parser.add_subparsers(dest="command", required=True)
    plot = commands.add_parser("plot", help="pictures/*.png in the folder of each run, study or comparison")
    plot.add_argument("folders", nargs="+", type=Path, metavar="RUN")
    plot.add_argument("--times", type=_times, help="times of the mid-plane's pictures [us], such as 15,30")
    plot.add_argument("--dpi", type=int, default=110)
    report = commands.add_parser("report", help="one HTML file about a run, about several beside each other, or about a study")
    report.add_argument("folders", nargs="+", type=Path, metavar="RUN")
    report.add_argument("-o", "--output", type=Path, help="default: report.html in the folder, of several runs here")
    report.add_argument("--undex", metavar="PROGRAM", help="the undex that is asked for the grades of materials")
    return parser


def _times(text: str) -> list[float]:
    return sorted(1e-6 * float(part) for part in text.split(",") if part.strip())


def _is_study(folder: Path) -> bool:
    return (folder / "study.json").is_file()


def _plot(options: argparse.Namespace) -> int:
    from .figures.comparison_figures import draw_comparison
    from .figures.run_figures import draw_run
    from .figures.study_figures import draw_study

    drawn = []
    for folder in options.folders:
        if _is_study(folder):
            drawn += draw_study(folder, options.dpi)
        elif (folder / "curves.csv").is_file():
            drawn += draw_comparison(folder, options.dpi)
        else:
            drawn += draw_run(folder, options.times, options.dpi)
    return DONE if drawn else _said("there was nothing to draw", FAILED)


def _report(options: argparse.Namespace) -> int:
    from .errors import Missing
    from .report.run_page import write_run_report
    from .report.study_page import write_study_report

    folders = options.folders
    output = options.output or (folders[0] / "report.html" if len(folders) == 1 else Path("report.html"))
    if output.is_dir():
        raise Missing(f"{output} is a folder; name a file, such as -o {output / 'report.html'}")
    if output.is_file() and "Made by undex report" not in output.read_text(encoding="utf-8", errors="replace"):
        raise Missing(f"{output} is there and is no report of undex; name another file with -o")
    if any(_is_study(folder) for folder in folders):
        if len(folders) > 1:
            raise Missing("a report is about one study, or about runs; give one folder of a study")
        write_study_report(folders[0], output)
    else:
        write_run_report(folders, output, options.undex)
    print(f"{output}  ({output.stat().st_size / 1e6:.1f} MB)")
    return DONE


def _said(message: str, code: int) -> int:
    print(f"undex_post: {message}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main())
