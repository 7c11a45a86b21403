# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""All images that the bench can make of one flow, on one sheet.

    pvpython Examples/contact_sheet.py                  (writes ladenburg_sheet.png)
    pvpython Examples/contact_sheet.py flow.vtu --array rho --view y --output flow.png

Options are those of Utilities/demo, see --help. No display is needed.
"""

import base64
import os
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, *folder) for folder in (("Examples",), ("Utilities", "four_images"))]

from arguments import JET, DemoError, options_or_exit, parse_arguments  # noqa: E402

DESCRIPTION = """\
Writes one PNG with all images that the bench can make of a flow field. Without FILE: an
under-expanded air jet that comes with the sources."""


def options_of(arguments):
    return parse_arguments(arguments, "contact_sheet.py", DESCRIPTION, "400x300", "_sheet.png", JET)


if __name__ == "__main__":  # --help and mistakes in the arguments need no ParaView
    OPTIONS = options_or_exit(options_of)

import numpy as np  # noqa: E402
import paraview.simple as pv  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGWriter  # noqa: E402

from bench import bounds_of, check_light, load_plugin, new_bench, new_medium, open_flow, output_of  # noqa: E402
from frame import Frame  # noqa: E402
from load_schlieren import plugin_file  # noqa: E402
from messages import Messages, say  # noqa: E402
from sheet import FigureError, Sheet, format_length, grey  # noqa: E402
from schlieren_figure import facts_of, rows_of  # noqa: E402

COLUMNS = 4


class Shot:
    """What the bench gives for some settings."""

    def __init__(self, image):
        arrays = image.GetPointData()
        names = [arrays.GetArrayName(index) for index in range(arrays.GetNumberOfArrays())]
        self.arrays = {name: rows_of(image, name).copy() for name in names}
        self.facts = {name: values[0] for name, values in facts_of(image).items() if values}
        self.half_width = image.GetSpacing()[0] * image.GetDimensions()[0] / 2

    def __getitem__(self, name):
        return self.arrays[name]


class Tile:
    """An image (rows x columns x 3 bytes, lowest row first) and what stands above it."""

    def __init__(self, name, title, line, pixels, shot=None, inset=None):
        self.name, self.title, self.line, self.pixels = name, title, line, pixels
        self.shot, self.inset = shot, inset


class Photographer:
    """Takes images with one bench, each from the same settings but for those it names."""

    def __init__(self, bench, messages):
        self.bench, self.messages = bench, messages
        self.changed = {}
        self.shots = 0

    def shoot(self, port=0, **settings):
        for name, value in self.changed.items():
            if name not in settings:
                setattr(self.bench, name, value)
        for name, value in settings.items():
            self.changed.setdefault(name, self.bench.GetProperty(name).GetData())
            setattr(self.bench, name, value)
        self.shots += 1
        what = settings.get("Cutoff", "Knife Edge").lower()
        return Shot(output_of(self.bench, f"image ({what})", self.messages, port))


def write_png(path, pixels):
    """Rows x columns x 3 bytes, lowest row first."""
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(np.ascontiguousarray(pixels).reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


def cutoff_plane(size):
    """The places u, v from -1 to 1 of the pixels of a square image."""
    places = (np.arange(size) + 0.5) * 2 / size - 1
    return np.meshgrid(places, places)


def four_colors(size=64):
    """A colour filter: grey in the middle, around it red, green, blue and yellow for light that is
    deflected to the right, upwards, to the left and downwards."""
    u, v = cutoff_plane(size)
    quarter = np.rint(np.arctan2(v, u) / (np.pi / 2)).astype(int) % 4
    colors = np.array([(230, 40, 30), (40, 200, 60), (40, 90, 255), (250, 210, 30)], np.uint8)
    pixels = colors[quarter]
    pixels[np.hypot(u, v) < 0.2] = 60
    return pixels


def wheel(size=40):
    """The colours that ColorFilter takes where it has no image, for the legend."""
    u, v = cutoff_plane(size)
    hue = np.arctan2(v, u) / np.pi * 3
    saturation = np.minimum(1, np.hypot(u, v))[..., None]
    rgb = np.clip(np.abs((hue[..., None] + np.array([0, 4, 2])) % 6 - 3) - 1, 0, 1)
    return np.rint(255 * (1 - saturation * (1 - rgb))).astype(np.uint8)


def shrunk(pixels, size=40):
    places = ((np.arange(size) + 0.5) * pixels.shape[0] / size).astype(int)
    return pixels[np.ix_(places, places)]


def data_uri(path):
    with open(path, "rb") as file:
        return "data:image/png;base64," + base64.b64encode(file.read()).decode()


def caustic_distance(deflection, pixel):
    """Where the strongest lenses of the flow focus: 1 / -(d eps / dx), their strongest half per cent."""
    (uy, ux), (vy, vx) = (np.gradient(deflection[..., i].astype(float), pixel) for i in (0, 1))
    half_trace = (ux + vy) / 2
    root = np.sqrt(np.maximum(half_trace ** 2 - (ux * vy - uy * vx), 0))
    strongest = np.percentile(root - half_trace, 99.5)
    return 1 / strongest if strongest > 0 else np.inf


def signed(values, full):
    """Grey, black at -full and white at full."""
    return grey(0.5 + values / (2 * full), 1)


def take_tiles(take, frame, options, scratch):
    """All tiles, in groups: (heading, tiles)."""
    def length(value):
        return format_length(value, options)

    pixel = frame.pixel
    knife = take.shoot(KnifeEdgeAngle=90)
    check_light(knife["BlockedFraction"], frame)
    k = knife.facts["KScale"] or 1  # 0: nothing bends light
    fixed = {"KMode": "Value", "KScale": k}
    eps = np.hypot(knife["Deflection"][..., 0], knife["Deflection"][..., 1])
    strong = max(float(np.percentile(eps, 99)), 1e-30)
    caustic = min(caustic_distance(knife["Deflection"], pixel), 1e6 * frame.depth)

    groups = []

    def group(heading):
        groups.append((heading, []))

    def add(name, title, line, pixels, shot=None, inset=None):
        groups[-1][1].append(Tile(name, title, line, pixels, shot, inset))

    def knife_tile(name, title, line, **settings):
        shot = take.shoot(**dict(fixed, **settings))
        add(name, title, line, grey(shot["Intensity"], 1), shot)
        return shot

    group(f"Knife edge: k = {k:.4g}, black to white is {-0.5 / k:.2g} to {0.5 / k:.2g} rad")
    knife_tile("knife 0", "Knife edge, 0°", "bright: light bent to the right")
    knife_tile("knife 90", "Knife edge, 90°", "bright: light bent upwards", KnifeEdgeAngle=90)
    knife_tile("knife 45", "Knife edge, 45°", "bright: light bent to the upper right",
               KnifeEdgeAngle=45)
    knife_tile("inverted", "Knife edge, 270°", "bright: light bent downwards",
               KnifeEdgeAngle=270)

    group("Other stops")
    knife_tile("offset", "Knife edge, 90°, a quarter further in", "undisturbed light: 0.25",
               KnifeEdgeAngle=90, CutoffOffset=0.25)
    steps = pv.CreatePiecewiseFunction(Points=[number for x, y in (
        (0, 0.1), (0.35, 0.1), (0.4, 1), (0.6, 1), (0.65, 0.4), (1, 0.4)) for number in (x, y, 0.5, 0)])
    knife_tile("graded", "Graded filter, 90°", "clear in its middle, 0.1 below, 0.4 above",
               Cutoff="Graded Filter", GradedFilter=steps, KnifeEdgeAngle=90)
    circular = take.shoot(Cutoff="Bright Field", KMode="Automatic")
    round_k = circular.facts["KScale"] or 1
    add("circular", "Bright field", f"1 - k |ε|, k = {round_k:.4g}", grey(circular["Intensity"], 1),
        circular)
    shot = take.shoot(Cutoff="Dark Field", KMode="Value", KScale=round_k)
    add("complement", "Its complement", "k |ε|: dark field", grey(shot["Intensity"], 1), shot)

    group("Colour, and where light meets the cutoff plane")
    shot = take.shoot(Cutoff="Color Filter", KMode="Value", KScale=round_k)
    add("wheel", "Colour wheel", "hue: direction, saturation: k |ε|", shot["Color"], shot, wheel())
    path = os.path.join(scratch, "filter.png")
    write_png(path, four_colors())
    shot = take.shoot(Cutoff="Color Filter", KMode="Value", KScale=round_k,
                      ColorFilterImage=data_uri(path))
    add("color filter", "Colour filter from a PNG", "stored as text in the property", shot["Color"],
        shot, shrunk(four_colors()))
    # The source's image is as wide as the deflection that goes from black to white.
    source = {"SourceShape": "Disc", "MirrorFocalLength": 1, "SourceWidth": 1e3 / k, "KnifeEdgeAngle": 90}
    knife_tile("disc knife", "Knife edge, 90°, round source", f"{1e3 / k:.2g} mm at f = 1 m",
               **source)
    shot = take.shoot(port=1)
    bins = min(frame.width, frame.height, 256)
    into = np.arange(256) * bins // 256
    rays = np.zeros((bins, bins))
    np.add.at(rays, (into[:, None], into[None, :]), shot["Rays"].astype(float))
    square = np.full((frame.height, frame.width, 3), 24, np.uint8)
    left = (frame.width - bins) // 2
    square[:bins, left:left + bins] = grey(np.log1p(rays), np.log1p(rays.max()))
    axes = square[:bins, left:left + bins]
    for line in (axes[bins // 2], axes[:, bins // 2]):
        np.maximum(line, 60, out=line)
    reach = shot.half_width
    add("histogram", "Histogram of the cutoff plane",
        f"rays by ε, {-reach:.2g} to {reach:.2g} rad, logarithmic", square, shot)

    def shadow_tile(name, title, line, **settings):
        shot = take.shoot(**dict({"Cutoff": "Shadowgraph", "ScreenDistance": caustic}, **settings))
        add(name, title, line, grey(shot["Intensity"], 2), shot)
        return shot

    group("Shadowgraph: black to white is 0 to 2 times the undisturbed light")
    shadow_tile("near", "Screen near the flow", f"{length(caustic / 8)} behind it",
                ScreenDistance=caustic / 8)
    shadow_tile("far", "Screen where the light focuses", f"{length(caustic)} behind it")
    shadow_tile("diverging", "The same screen in diverging light",
                f"from {length(4 * frame.depth)} before the middle", SourceDistance=4 * frame.depth)
    blur = 8 * pixel
    shadow_tile("disc", "Round source", f"blurs what is {length(caustic)} off by 8 pixels",
                SourceShape="Disc", MirrorFocalLength=1, SourceWidth=1e3 * blur / caustic,
                SamplesPerPixel=64)  # as many places of the source

    def fringe_tile(name, title, line, **settings):
        shot = take.shoot(Cutoff="Interferogram", **settings)
        add(name, title, line, grey(shot["Intensity"], 1), shot)
        return shot

    wavelength = take.bench.Wavelength
    group(f"Interferogram: {wavelength:g} nm")
    paths = knife["OpticalPathDifference"]
    fringe_tile("infinite", "Infinite fringes",
                f"path differences of {np.ptp(paths) * 1e9 / wavelength:.3g} wavelengths")
    spacing = frame.height * pixel / 16
    fringe_tile("finite", "Finite fringes", f"{length(spacing)} apart", FringeSpacing=spacing,
                FringeAngle=90)
    fringe_tile("upright", "Finite fringes", f"{length(spacing)} apart, upright",
                FringeSpacing=spacing, FringeAngle=0)
    fringe_tile("violet", "At 405 nm", "more fringes, and other ones but for the zeroth", Wavelength=405)

    away = 8 * pixel / strong
    dots = {"Cutoff": "Background Oriented", "BackgroundDistance": away}
    group(f"Background-oriented schlieren: the pattern is {length(away)} behind the flow")
    shot = take.shoot(**dots)
    add("pattern", "The pattern", "without the flow", grey(shot["Background"], 1), shot)
    add("seen", "The pattern through the flow", "what a camera sees", grey(shot["Intensity"], 1), shot)
    shift = shot["BackgroundDisplacement"]
    add("shift", "How much higher the place is that is seen", "black to white: -8 to 8 pixels",
        signed(shift[..., 1], 8 * pixel), shot)
    stripes = take.shoot(**dict(dots, BackgroundPattern="Stripes", FringeAngle=90))
    add("stripes", "Stripes through the flow", "horizontal ones", grey(stripes["Intensity"], 1), stripes)

    group("Line of sight and refraction, on the screen where the light focuses")
    straight = shadow_tile("straight", "Straight rays", "the line-of-sight approximation",
                           PathModel="Straight")
    bent = shadow_tile("refracted", "Refracted rays", "they leave where they were bent to",
                       PathModel="Refracted")
    difference = bent["Intensity"].astype(float) - straight["Intensity"]
    full = max(float(np.percentile(np.abs(difference), 99.5)), 1e-6)
    add("difference", "Refracted - straight", f"black to white: {-full:.2g} to {full:.2g}",
        signed(difference, full))
    full = float(np.abs(paths).max()) or 1
    add("path", "Optical path difference",
        f"as data; black to white: {-full * 1e6:.2g} to {full * 1e6:.2g} µm", signed(paths, full), knife)

    beyond = 2.5 * caustic
    group(f"Film: a shadowgraph from few rays, the screen {length(beyond)} behind the flow")
    shadow_tile("one", "1 ray per pixel", "light between neighbouring rays", SamplesPerPixel=1,
                ScreenDistance=beyond)
    shadow_tile("smoothed", "Smoothed", "the same, radius of 4 pixels", SamplesPerPixel=1, SmoothingRadius=4,
                ScreenDistance=beyond)
    shadow_tile("four", "4 rays per pixel", "what is finer than a pixel, too", SamplesPerPixel=4,
                ScreenDistance=beyond)
    shadow_tile("many", "64 rays per pixel", "to compare with", SamplesPerPixel=64, ScreenDistance=beyond)
    return groups


def layout(frame, rows):
    """The sheet's size, and where the upper left corner of a tile is (row, column)."""
    margin, head, heading, above, between = 28, 84, 40, 44, 20
    column = max(frame.width, 260) + margin
    row = heading + above + frame.height + between

    def corner(j, i):
        return margin + i * column, head + j * row + heading + above

    return COLUMNS * column + margin, head + rows * row + 24, corner


def compose(groups, frame, used, options, facts):
    width, height, corner = layout(frame, len(groups))
    sheet = Sheet(width, height)
    room = width - 56
    looking = ", ".join(f"{part + 0.0:.3g}" for part in frame.direction)
    sheet.text(28, 16, f"{os.path.basename(options.file)}: {used}", 26, room=room)
    sheet.text(28, 50, f"Looking along ({looking}). Each image is "
               f"{format_length(frame.right - frame.left, options)} wide; depth of the data: "
               f"{format_length(frame.depth, options)}.", 15, sheet.DIM, room=room)
    for j, (heading, tiles) in enumerate(groups):
        left, top = corner(j, 0)
        sheet.fill(left, top - 80, room, 1, sheet.BORDER)
        sheet.text(left, top - 75, heading, 17, "#8a4b00", room=room)
        for i, tile in enumerate(tiles):
            left, top = corner(j, i)
            free = frame.width - (tile.inset.shape[1] + 6 if tile.inset is not None else 0)
            sheet.text(left, top - 41, tile.title, 15, room=free)
            sheet.text(left, top - 21, tile.line, 13, sheet.DIM, room=free)
            sheet.image(left, top, tile.pixels)
            if tile.inset is not None:
                side = tile.inset.shape[0]
                sheet.image(left + frame.width - side, top - side - 3, tile.inset)
    sheet.text(width - 28, height - 24, f"traced on the {facts['Device']}", 13, sheet.DIM, "right")
    return sheet


def main(options):
    """Writes the sheet; (groups of tiles, frame)."""
    options.plugin = options.plugin or plugin_file()
    messages = Messages()
    load_plugin(options, messages)
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        reader, array, used = open_flow(options, scratch, messages)
        frame = Frame(bounds_of(reader, new_medium(reader, array, options), options), options)
        say(f"Tracing rays, {frame.width} x {frame.height} pixels")
        take = Photographer(new_bench(reader, array, frame, options), messages)
        groups = take_tiles(take, frame, options, scratch)
        compose(groups, frame, used, options, groups[0][1][0].shot.facts).write(options.output)
    say(f"{take.shots} images in {time.monotonic() - begin:.0f} s")
    say(f"The sheet: {os.path.abspath(options.output)}")
    return groups, frame


if __name__ == "__main__":
    try:
        main(OPTIONS)
    except (DemoError, FigureError) as problem:
        print(f"error: {' '.join(str(problem).split())}", file=sys.stderr)
        sys.exit(1)
