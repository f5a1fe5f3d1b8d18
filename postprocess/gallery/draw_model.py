#!/usr/bin/python3
"""Draws model.svg: the free body of the block, and the machine of its modes. Plain SVG, no packages.

    postprocess/gallery/draw_model.py > postprocess/gallery/model.svg
"""
from math import atan2, cos, degrees, hypot, pi, radians, sin

INK, MUTED, LINE = "#1d2430", "#626b78", "#c3c8cf"
FORCE = "#b34700"
MODES = {"rest": "#8d95a1", "slide": "#0072b2", "rock": "#b87f00", "slide-rock": "#00805c", "flight": "#8a3f80", "overturned": "#d55e00"}
out = []


def add(text):
    out.append(text)


def label(x, y, text, size=15, colour=INK, anchor="middle", weight=400, style="normal"):
    add(f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{colour}" text-anchor="{anchor}" font-weight="{weight}" '
        f'font-style="{style}">{text}</text>')


def symbol(x, y, text, colour=INK, anchor="middle", size=17):
    label(x, y, text, size, colour, anchor, style="italic")


def path(points, colour=INK, width=1.5, fill="none", dash="", close=False, arrow=False, both=False):
    data = "M" + " L".join(f"{x:.1f} {y:.1f}" for x, y in points) + (" Z" if close else "")
    _stroke(data, colour, width, fill, dash, arrow, both)


def _stroke(data, colour, width, fill="none", dash="", arrow=False, both=False):
    ends = f' marker-end="url(#a{colour[1:]})"' if arrow or both else ""
    ends += f' marker-start="url(#a{colour[1:]})"' if both else ""
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    add(f'<path d="{data}" stroke="{colour}" stroke-width="{width}" fill="{fill}"{dashes}{ends} stroke-linejoin="round"/>')


def arc(centre, radius, start, end, colour):
    """Angles from the vertical, clockwise, in radians."""
    points = [(centre[0] + radius * sin(start + (end - start) * i / 24), centre[1] - radius * cos(start + (end - start) * i / 24))
              for i in range(25)]
    path(points, colour, 1.3)


def free_body():
    label(40, 40, "One block on a moving floor", 18, anchor="start", weight=650)
    floor, corner = 420, (275, 420)
    b, h, theta = 78, 140, radians(12)
    alpha, R = atan2(b, h), hypot(b, h)
    turn = lambda x, y: (corner[0] + x * cos(theta) - y * sin(theta), corner[1] + x * sin(theta) + y * cos(theta))  # noqa: E731
    add(f'<rect x="40" y="{floor}" width="390" height="12" fill="url(#hatch)"/>')
    path([(40, floor), (430, floor)], INK, 1.8)
    start = corner[0] - 62
    path([(start - 2 * b, floor), (start - 2 * b, floor - 2 * h), (start, floor - 2 * h), (start, floor)], LINE, 1.2, dash="5 4")
    path([turn(0, 0), turn(-2 * b, 0), turn(-2 * b, -2 * h), turn(0, -2 * h)], INK, 2, fill="#eef3f8", close=True)
    mass = turn(-b, -h)
    path([corner, (corner[0], corner[1] - 195)], MUTED, 1, dash="4 4")
    path([corner, mass], MUTED, 1.3)
    arc(corner, 100, theta - alpha, 0, MUTED)
    arc(corner, 170, 0, theta, MUTED)
    arc(corner, 62, theta - alpha, theta, MUTED)
    symbol(corner[0] - 20, corner[1] - 110, "φ")
    symbol(corner[0] + 19, corner[1] - 178, "θ")
    symbol(corner[0] - 5, corner[1] - 68, "α")
    symbol(0.72 * corner[0] + 0.28 * mass[0] - 15, 0.72 * corner[1] + 0.28 * mass[1] + 2, "R")
    _dimensions(turn, b, h)
    add(f'<circle cx="{mass[0]:.1f}" cy="{mass[1]:.1f}" r="4" fill="{INK}"/>')
    path([mass, (mass[0], mass[1] + 70)], FORCE, 2.2, arrow=True)
    symbol(mass[0] - 14, mass[1] + 66, "m g′", FORCE, "end")
    path([(corner[0], corner[1] + 78), (corner[0], corner[1] + 7)], FORCE, 2.2, arrow=True)
    path([(corner[0] + 85, corner[1] - 9), (corner[0] + 9, corner[1] - 9)], FORCE, 2.2, arrow=True)
    symbol(corner[0] + 12, corner[1] + 70, "f<tspan font-size='12' dy='4'>y</tspan>", FORCE, "start")
    symbol(corner[0] + 92, corner[1] - 8, "f<tspan font-size='12' dy='4'>x</tspan>", FORCE, "start")
    path([(start, floor + 30), (corner[0], floor + 30)], INK, 1.2, both=True)
    symbol((start + corner[0]) / 2, floor + 49, "x")
    path([(60, floor + 40), (135, floor + 40)], INK, 2.2, arrow=True)
    symbol(97, floor + 62, "a(t)")
    label(40, 528, "g′ = g + v(t): v is the vertical acceleration of the floor.", 13.5, MUTED, "start")
    label(40, 548, "Contact: 0 ≤ f<tspan font-size='10' dy='3'>y</tspan><tspan dy='-3'>,  |f</tspan><tspan font-size='10' dy='3'>x</tspan>"
          "<tspan dy='-3'>| ≤ μ f</tspan><tspan font-size='10' dy='3'>y</tspan><tspan dy='-3'>.  Slip speed w = dx/dt.</tspan>",
          13.5, MUTED, "start")


def _dimensions(turn, b, h):
    """b and h beside the block, along its sides."""
    path([turn(-2 * b, -2 * h - 16), turn(-b, -2 * h - 16)], MUTED, 1.2, both=True)
    symbol(*[c + d for c, d in zip(turn(-1.5 * b, -2 * h - 16), (4, -9))], "b")
    path([turn(-2 * b - 16, -2 * h), turn(-2 * b - 16, -h)], MUTED, 1.2, both=True)
    symbol(*[c + d for c, d in zip(turn(-2 * b - 16, -1.5 * h), (-15, 4))], "h")


BOX = (124, 54)
PLACE = {"rest": (620, 440), "slide": (900, 440), "rock": (620, 240), "slide-rock": (900, 240), "flight": (760, 92), "overturned": (1085, 140)}


def modes():
    label(466, 40, "Its modes, and what ends them", 18, anchor="start", weight=650)
    for y, text in ((240, "one corner"), (440, "both corners")):
        label(466, y + 5, text, 13, MUTED, "start")
    for x, text in ((620, "stuck"), (900, "slipping")):
        label(x, 508, text, 13.5, MUTED)
    go("rest", "slide", (60, -14), (-62, -14), "|a| &gt; μ<tspan font-size='10' dy='3'>s</tspan><tspan dy='-3'> g′</tspan>", (0, -24))
    go("slide", "rest", (-62, 14), (62, 14), "w = 0, and sticks", (0, 33))
    go("rock", "slide-rock", (62, -14), (-62, -14), "|f<tspan font-size='10' dy='3'>x</tspan><tspan dy='-3'>| &gt; μ</tspan>"
       "<tspan font-size='10' dy='3'>s</tspan><tspan dy='-3'> f</tspan><tspan font-size='10' dy='3'>y</tspan>", (0, -24))
    go("slide-rock", "rock", (-62, 14), (62, 14), "w = 0, and sticks", (0, 33))
    go("rest", "rock", (-16, -27), (-16, 28), "|a| &gt; g′ tan α", (-10, 5), "end")
    go("rock", "rest", (16, 27), (16, -28), "impact ends it", (12, 5), "start")
    go("slide", "slide-rock", (-16, -27), (-16, 28), "μ<tspan font-size='10' dy='3'>k</tspan><tspan dy='-3'> &gt; b/h</tspan>", (-10, 5), "end")
    go("slide-rock", "slide", (16, 27), (16, -28), "impact ends it", (12, 5), "start")
    go("rock", "flight", (-5, -27), (-64, 12), "f<tspan font-size='10' dy='3'>y</tspan><tspan dy='-3'> = 0</tspan>", (-18, -8), "end", both=True)
    go("slide-rock", "flight", (5, -27), (64, 12), "", (0, 0), both=True)
    go("slide-rock", "overturned", (62, -4), (-40, 28), "|θ| &gt; π/2", (32, 22), "start")
    _stroke("M 640 213 C 690 150, 850 160, 1022 143", INK, 1.5, arrow=True)
    impact_loop()
    for name, (x, y) in PLACE.items():
        add(f'<rect x="{x - BOX[0] / 2}" y="{y - BOX[1] / 2}" width="{BOX[0]}" height="{BOX[1]}" rx="9" fill="{MODES[name]}"/>')
        label(x, y + 6, name, 17, "#ffffff", weight=650)
    label(832, 84, "no corner;", 12.5, MUTED, "start")
    label(832, 100, "ends when one lands", 12.5, MUTED, "start")
    label(1085, 186, "for good", 12.5, MUTED)
    label(466, 548, "At a jump of a(t): the mode whose accelerations and contact forces agree, found by trying the few candidates.",
          13, MUTED, "start")


def go(start, end, leave, arrive, text, shift, anchor="middle", both=False):
    a = [c + d for c, d in zip(PLACE[start], leave)]
    b = [c + d for c, d in zip(PLACE[end], arrive)]
    path([a, b], INK, 1.5, arrow=True, both=both)
    if text:
        label((a[0] + b[0]) / 2 + shift[0], (a[1] + b[1]) / 2 + shift[1], text, 14, INK, anchor)


def impact_loop():
    """Rocking goes on about the other corner."""
    x, y = PLACE["rock"]
    _stroke(f"M {x - 62} {y - 12} C {x - 100} {y - 50}, {x - 66} {y - 74}, {x - 44} {y - 30}", INK, 1.5, arrow=True)
    label(x - 92, y - 62, "θ = 0: impact,", 13, INK, "end")
    label(x - 92, y - 45, "other corner", 13, INK, "end")


def marker(colour):
    return (f'<marker id="a{colour[1:]}" viewBox="0 0 10 10" refX="8" refY="5" markerWidth="6.5" markerHeight="6.5" orient="auto-start-reverse">'
            f'<path d="M0 0.8 L9 5 L0 9.2 Z" fill="{colour}"/></marker>')


free_body()
modes()
print('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1180 570" font-family="Inter, Helvetica, Arial, sans-serif" role="img" '
      'aria-label="Free body of the block, and the machine of its modes">')
print("<defs>" + "".join(marker(colour) for colour in (INK, MUTED, FORCE)) +
      f'<pattern id="hatch" width="8" height="8" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">'
      f'<line x1="0" y1="0" x2="0" y2="8" stroke="{MUTED}" stroke-width="1.4"/></pattern></defs>')
print('<rect width="1180" height="570" fill="#ffffff"/>')
print("\n".join(out))
print("</svg>")
