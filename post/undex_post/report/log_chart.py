"""Charts with two logarithmic axes as SVG, whose points are links."""
import math
from dataclasses import dataclass, field
from html import escape

from ..units import number

WIDTH, HEIGHT = 460.0, 330.0
LEFT, RIGHT, TOP, BOTTOM = 62.0, 14.0, 12.0, 44.0
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8a6d00", "#7a7a7a"]
DASHES = ["", "8 4", "2 3", "10 3 2 3"]


@dataclass
class Point:
    x: float
    y: float
    words: str  # what it is, shown when pointed at
    link: str


@dataclass
class Line:
    """A curve with points, in a colour and a dash."""

    label: str
    points: list[Point]
    colour: int = 0
    dash: int = 0


@dataclass
class LogChart:
    """Curves over x, both logarithmic; `front` is a staircase behind them, `slopes` are orders drawn as guides."""

    x_label: str
    y_label: str
    lines: list[Line]
    front: list[tuple[float, float]] = field(default_factory=list)
    slopes: tuple[int, ...] = ()

    def svg(self) -> str:
        """The chart as an SVG element; without points an empty text."""
        points = [point for line in self.lines for point in line.points]
        if not points:
            return ""
        self._x = _range([point.x for point in points])
        self._y = _range([point.y for point in points])
        parts = [
            f'<svg class="study" viewBox="0 0 {WIDTH:.0f} {HEIGHT:.0f}" role="group" aria-label="{escape(self.y_label)} over {escape(self.x_label)}" '
            'font-family="system-ui, sans-serif">',
            *self._axes(),
            *self._front(),
            *self._slopes(points),
        ]
        for line in self.lines:
            parts += self._line(line)
        return "\n".join([*parts, "</svg>"])

    def _at(self, x: float, y: float) -> tuple[float, float]:
        share = lambda value, ends: (math.log10(value) - ends[0]) / (ends[1] - ends[0])
        return (LEFT + (WIDTH - LEFT - RIGHT) * share(x, self._x), HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * share(y, self._y))

    def _axes(self) -> list[str]:
        parts = []
        for value in _ticks(*self._x):
            x, _ = self._at(value, 10 ** self._y[0])
            parts.append(
                f'<line class="grid" x1="{x:.1f}" x2="{x:.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}"/>'
                f'<text class="tick" x="{x:.1f}" y="{HEIGHT - BOTTOM + 17}" text-anchor="middle">{number(value, 2)}</text>'
            )
        for value in _ticks(*self._y):
            _, y = self._at(10 ** self._x[0], value)
            parts.append(
                f'<line class="grid" x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y:.1f}" y2="{y:.1f}"/>'
                f'<text class="tick" x="{LEFT - 7}" y="{y + 4:.1f}" text-anchor="end">{number(value, 2)}</text>'
            )
        parts.append(
            f'<text x="{WIDTH - RIGHT}" y="{HEIGHT - 10}" text-anchor="end">{escape(self.x_label)}</text>'
            f'<text transform="translate(12 {TOP + 4}) rotate(-90)" text-anchor="end">{escape(self.y_label)}</text>'
        )
        return parts

    def _front(self) -> list[str]:
        if not self.front:
            return []
        places = [self._at(*point) for point in sorted(self.front)]
        path = f"M{places[0][0]:.1f} {places[0][1]:.1f}" + "".join(f" H{x:.1f} V{y:.1f}" for x, y in places[1:])
        rings = "".join(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="9" fill="none" stroke="#888" stroke-width="1.2"/>' for x, y in places
        )
        return [
            f'<path d="{path}" fill="none" stroke="#888" stroke-width="6" stroke-opacity=".3" stroke-linecap="round"/>{rings}'
        ]

    def _slopes(self, points: list[Point]) -> list[str]:
        coarse, fine = max(point.x for point in points), min(point.x for point in points)
        if coarse / fine < 1.01:
            return []
        parts = []
        for order in self.slopes:
            low = 0.75 * min(point.y * (coarse / point.x) ** order for point in points)
            ends = (fine, low * (fine / coarse) ** order), (coarse, low)
            (x1, y1), (x2, y2) = (self._at(x, max(y, 10 ** self._y[0])) for x, y in ends)
            if ends[0][1] < 10 ** self._y[0]:  # cut where the chart ends
                x1, y1 = self._at(coarse * (10 ** self._y[0] / low) ** (1 / order), 10 ** self._y[0])
            parts.append(
                f'<path d="M{x1:.1f} {y1:.1f} L{x2:.1f} {y2:.1f}" stroke="#888" stroke-dasharray="4 3" fill="none"/>'
                f'<text class="tick" x="{(x1 + x2) / 2 + 5:.1f}" y="{(y1 + y2) / 2 + 13:.1f}">order {order}</text>'
            )
        return parts

    def _line(self, line: Line) -> list[str]:
        colour = COLOURS[line.colour % len(COLOURS)]
        places = [self._at(point.x, point.y) for point in line.points]
        path = " L".join(f"{x:.1f} {y:.1f}" for x, y in places)
        dash = f' stroke-dasharray="{DASHES[line.dash % len(DASHES)]}"' if line.dash % len(DASHES) else ""
        parts = [f'<path d="M{path}" fill="none" stroke="{colour}" stroke-width="1.8"{dash}/>']
        for point, (x, y) in zip(line.points, places):
            parts.append(
                f'<a href="{escape(point.link)}" aria-label="{escape(point.words)}"><circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{colour}">'
                f"<title>{escape(point.words)}</title></circle></a>"
            )
        return parts


def _range(values: list[float]) -> tuple[float, float]:
    """Ends of an axis in decades, with room about the values."""
    low, high = math.log10(min(values)), math.log10(max(values))
    room = max(0.06 * (high - low), 0.08)
    return low - room, high + room


def _ticks(low: float, high: float) -> list[float]:
    """Round values between two powers of ten: decades, and parts of them where there are few."""
    parts = (1,) if high - low > 2.5 else (1, 2, 5) if high - low > 1 else (1, 1.5, 2, 3, 4, 5, 7)
    return [
        part * 10.0**k
        for k in range(math.floor(low), math.ceil(high) + 1)
        for part in parts
        if low <= math.log10(part * 10.0**k) <= high
    ]
