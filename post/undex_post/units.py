"""Numbers with units, as people write them."""
import math
import re

_PREFIXED = {
    "Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")),
    "m": ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm")),
    "s": ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")),
    "J": ((1e6, "MJ"), (1e3, "kJ"), (1.0, "J")),
    "Pa s": ((1e6, "MPa s"), (1e3, "kPa s"), (1.0, "Pa s")),
    "N": ((1e6, "MN"), (1e3, "kN"), (1.0, "N")),
    "kg": ((1e3, "t"), (1.0, "kg"), (1e-3, "g"), (1e-6, "mg")),
    "m3": ((1.0, "m³"), (1e-6, "cm³"), (1e-9, "mm³")),
    "J/kg": ((1e6, "MJ/kg"), (1e3, "kJ/kg"), (1.0, "J/kg")),
    "byte": ((1e9, "GB"), (1e6, "MB"), (1e3, "kB"), (1.0, "byte")),
}
_SUFFIXES = (("_kg_m3", "kg/m3"), ("_j_m2", "J/m2"), ("_pa_s", "Pa s"), ("_m_s", "m/s"), ("_pa", "Pa"), ("_m", "m"), ("_s", "s"))
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_POWERS = {"m3": "m³", "m2": "m²", "kg/m3": "kg/m³", "J/m2": "J/m²", "-": "", "": ""}


def pretty_unit(unit: str) -> str:
    return _POWERS.get(unit, unit)


def scale_for(unit: str, largest: float) -> tuple[float, str]:
    """The factor and the unit in which numbers up to `largest` [unit] are best written."""
    if unit in _PREFIXED and math.isfinite(largest) and largest > 0:
        for size, name in _PREFIXED[unit]:
            if largest >= 0.9999 * size:
                return 1 / size, name
        size, name = _PREFIXED[unit][-1]
        return 1 / size, name
    if unit in _PREFIXED:
        return 1.0, dict((size, name) for size, name in _PREFIXED[unit])[1.0]
    return 1.0, pretty_unit(unit)


def number(value: float | int | None, digits: int = 4) -> str:
    """A number in so many digits, or a dash."""
    if value is None or not math.isfinite(value):
        return "–"
    if isinstance(value, int) or (value == int(value) and abs(value) < 1e15 and abs(value) >= 10 ** (digits - 1)):
        return f"{int(value):,}"
    text = f"{value:.{digits}g}"
    if "e" in text:
        head, _, power = text.partition("e")
        return f"{head}·10{str(int(power)).translate(_RAISED)}"
    return text


def quantity(value: float | None, unit: str, digits: int = 4) -> str:
    """A value in SI with the unit that suits it: quantity(5.7e8, "Pa") is "570 MPa"."""
    if value is None or not math.isfinite(value):
        return "–"
    factor, name = scale_for(unit, abs(value))
    return f"{number(value * factor, digits)} {name}".rstrip()


def percent(share: float | None, digits: int = 1) -> str:
    return "–" if share is None or not math.isfinite(share) else f"{100 * share:+.{digits}f} %"


def unit_of_metric(name: str) -> str:
    """The SI unit that the end of a metric's name tells."""
    stem = re.sub(r"_(x|y|z)$", "", name)
    return next((unit for suffix, unit in _SUFFIXES if stem.endswith(suffix)), "")


def label_of_metric(name: str) -> str:
    """The name of a metric in words, without its unit."""
    suffix = next((suffix for suffix, _ in _SUFFIXES if name.endswith(suffix)), "")
    words = name[: len(name) - len(suffix)] if suffix else name
    words = re.sub(r"_(\d+)us\b", r" at \1 µs", words)
    words = re.sub(r"_(\d+)_(\d+)us\b", r" \1 to \2 µs", words)
    return words.replace("_", " ").strip()


def shorter(text: str, length: int) -> str:
    return text if len(text) <= length else text[: length - 1].rstrip() + "…"
