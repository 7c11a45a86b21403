# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One flow field, four pictures of the same view in one PNG: a volume rendering, what a schlieren
bench shows with a vertical and with a horizontal knife edge, and a shadowgraph.

Started by Utilities/demo, or by hand:

    xvfb-run -a pvpython Examples/demo.py --plugin .../Schlieren.so FILE --array rho
"""

import argparse
import ast
import base64
import math
import os
import re
import struct
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
JET = os.path.join(ROOT, "Testing", "Data", "ladenburg_jet_3d.vti")

MODELS = {
    # index model: the property that takes the array, and the names an array of that kind often has
    "Gladstone-Dale": ("Density", ("rho", "density", "dens", "d")),
    "Refractive Index": ("IndexArray", ("n", "refractiveindex", "refractive_index", "ior")),
    "Refractivity": ("IndexArray", ("refractivity", "n-1")),
}

# Sight lines by name: the direction of sight and what is up in the picture.
VIEWS = {
    "x": ((-1, 0, 0), (0, 0, 1)), "-x": ((1, 0, 0), (0, 0, 1)),
    "y": ((0, 1, 0), (0, 0, 1)), "-y": ((0, -1, 0), (0, 0, 1)),
    "z": ((0, 0, -1), (0, 1, 0)), "-z": ((0, 0, 1), (0, 1, 0)),
}


class DemoError(Exception):
    """Something the user can put right. The text says what, why and how."""


# ---------------------------------------------------------------------------------------------
# What the user asks for


def triple(text):
    numbers = [float(part) for part in text.split(",")]
    if len(numbers) != 3 or not all(map(math.isfinite, numbers)):
        raise ValueError
    return numbers


def view_direction(text):
    if text in VIEWS:
        return VIEWS[text]
    try:
        direction = triple(text)
        length = math.hypot(*direction)
        direction = [part / length for part in direction]
    except (ValueError, ZeroDivisionError):
        raise argparse.ArgumentTypeError(
            f"'{text}' is neither x, y, z, -x, -y, -z nor three numbers X,Y,Z")
    return direction, ((0, 0, 1) if abs(direction[2]) < 0.9 else (0, 1, 0))


def vector(text):
    try:
        return triple(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not three numbers X,Y,Z")


def positive(text):
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number above 0")
    return number


def size(text):
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    numbers = tuple(map(int, match.groups())) if match else (0, 0)
    if not all(16 <= number <= 8192 for number in numbers):
        raise argparse.ArgumentTypeError(f"'{text}' is not WIDTHxHEIGHT, 16 to 8192 pixels each")
    return numbers


def setting(text):
    name, equals, value = text.partition("=")
    if not equals or not name.isidentifier():
        raise argparse.ArgumentTypeError(f"'{text}' is not PROPERTY=VALUE")
    try:
        value = ast.literal_eval(value)
    except (ValueError, SyntaxError):
        pass  # a word, such as Linear
    return name, list(value) if isinstance(value, tuple) else value


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        prog="demo", formatter_class=argparse.RawDescriptionHelpFormatter,
        description="""\
Writes one PNG with four pictures of the same view of a flow field: volume rendering, schlieren with
a vertical and with a horizontal knife edge, and shadowgraph. Without FILE: an under-expanded air
jet that comes with the sources.""",
        epilog="""\
examples:
  demo
  demo flow.vtu --array rho --view y
  demo bluntfinxyz.bin --density-scale 0.72 --length-scale 0.0127
  demo plume.vti --set Interpolation=Linear --set SamplesPerPixel=1""")
    add = parser.add_argument
    add("file", nargs="?", metavar="FILE",
        help="a 3-D data set, in any format that ParaView reads; of a PLOT3D pair, the grid file")
    add("--q", metavar="FILE",
        help="the solution file of a PLOT3D pair, where its name does not follow from the grid's")
    add("--time", type=float, metavar="T", help="the time to read; default: the last one")
    add("--array", metavar="NAME",
        help="point or cell array that holds the density, n or n - 1, as --model says; default: "
             "one that is named so")
    add("--model", choices=MODELS, default="Gladstone-Dale",
        help="what the array holds; default: a density (Gladstone-Dale: n - 1 = K x density)")
    add("--constant", type=positive, default=2.26e-4, metavar="K",
        help="Gladstone-Dale constant in m^3/kg; default: %(default)s, air in visible light")
    add("--density-scale", type=positive, default=1, metavar="S",
        help="kg/m^3 for a density of 1; default: 1")
    add("--length-scale", type=positive, default=1, metavar="S",
        help="metres for a length of 1; default: 1")
    add("--view", type=view_direction, default="z", metavar="x|y|z|X,Y,Z",
        help="the axis to look along: x and z point at the viewer, y away from the viewer, a minus "
             "sign turns that round (--view=-x); or the direction of sight; default: z")
    add("--up", type=vector, metavar="X,Y,Z", help="what is up in the picture")
    add("--center", type=vector, metavar="X,Y,Z",
        help="the point in the middle of the picture; default: the data's")
    add("--half-height", type=positive, metavar="H",
        help="half the picture's height, in the data's unit; default: all of the data is seen")
    add("--size", type=size, metavar="WxH",
        help="pixels of each of the four pictures; default: at most 880x640, in the data's "
             "proportions")
    add("--set", type=setting, action="append", default=[], metavar="PROPERTY=VALUE",
        dest="settings", help="any other property of the Schlieren filter; may be repeated")
    add("--output", metavar="PNG", help="default: FILE_schlieren.png in the current folder")
    add("--plugin", default=os.environ.get("SCHLIEREN_PLUGIN"), metavar="SO",
        help="the plugin's file; default: the environment variable SCHLIEREN_PLUGIN, which "
             "Utilities/demo sets")
    add("--check", action="store_true", help="check the arguments and stop")
    options = parser.parse_args(arguments)

    options.file = options.file or JET
    for path in filter(None, (options.file, options.q)):
        if not os.path.exists(path):
            raise DemoError(f"There is no file '{path}'.")
        if os.path.isdir(path) or not os.access(path, os.R_OK):
            raise DemoError(f"'{path}' is a folder or may not be read by you.")
    if options.output is None:
        options.output = os.path.splitext(os.path.basename(options.file))[0] + "_schlieren.png"
    folder = os.path.dirname(os.path.abspath(options.output))
    if not os.path.isdir(folder) or not os.access(folder, os.W_OK):
        raise DemoError(f"Cannot write '{options.output}': '{folder}' is no folder that you may "
                        "write to.")
    if not options.output.lower().endswith(".png"):
        raise DemoError(f"Cannot write '{options.output}': the picture is a PNG, name it *.png.")
    if options.up:
        cross = [options.view[0][(i + 1) % 3] * options.up[(i + 2) % 3]
                 - options.view[0][(i + 2) % 3] * options.up[(i + 1) % 3] for i in range(3)]
        if math.hypot(*cross) < 1e-6 * math.hypot(*options.up) or not any(options.up):
            raise DemoError("--up points along the line of sight, or nowhere: give another one.")
        options.view = (options.view[0], options.up)
    return options


try:
    OPTIONS = parse_arguments(sys.argv[1:])
except DemoError as problem:
    sys.exit(f"error: {problem}")
if OPTIONS.check:
    sys.exit(0)

# Only now: --help and mistakes in the arguments need no ParaView.
import numpy as np  # noqa: E402
import paraview.simple as pv  # noqa: E402
from paraview import servermanager  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter  # noqa: E402
from vtkmodules.vtkRenderingCore import vtkTextProperty, vtkTextRenderer  # noqa: E402
import vtkmodules.vtkRenderingFreeType  # noqa: E402,F401  (draws the text)

START = time.monotonic() - float(os.environ.get("SCHLIEREN_ELAPSED", 0))


def say(text):
    print(f"[{time.monotonic() - START:4.0f} s] {text}", flush=True)


class Messages:
    """Keeps what VTK would print, so that the user sees one line and not a page."""

    def __init__(self):
        # pvpython prints through VTK's output window: go round it.
        sys.stdout, sys.stderr = sys.__stdout__, sys.__stderr__
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)
        self.seen = 0

    def last_error(self):
        """The newest error since the last call, without VTK's file name and address; or nothing."""
        text = self.window.GetOutput()
        new, self.seen = text[self.seen:], len(text)
        errors = re.findall(r"ERROR: In .*?\n.*?\(0x[0-9a-f]+\): (.*?)\n\n", new + "\n\n",
                            re.DOTALL)
        return " ".join(errors[0].split()) if errors else ""


# ---------------------------------------------------------------------------------------------
# Reading


def plot3d_solution(path):
    """The solution file beside a PLOT3D grid file: xyz -> q in the name, or .x, .g, .grid -> .q."""
    folder, name = os.path.split(path)
    guesses = [name.replace("xyz", "q"), name.replace("XYZ", "Q")]
    guesses += [re.sub(r"\.(x|g|grid|grd)(?=\.|$)", ".q", name)]
    for guess in guesses:
        if guess != name and os.path.isfile(os.path.join(folder, guess)):
            return os.path.join(folder, guess)
    return None


def inline_appended_data(source, target):
    """Copies a VTK XML file, its appended data moved into the elements that they belong to.

    VTK 9.2 cannot read appended data with an expat library that has reparse deferral (2.6, and
    distributions' security updates of older ones); data inside the elements it can.
    Returns False where there are no appended data.
    """
    with open(source, "rb") as stream:
        data = stream.read()
    tag = re.search(rb'<AppendedData\s+encoding="(raw|base64)"\s*>\s*_', data)
    if tag is None:
        return False
    head, start, raw = data[:tag.start()], tag.end(), tag.group(1) == b"raw"
    word = ">" if b'byte_order="BigEndian"' in head else "<"
    word += "Q" if b'header_type="UInt64"' in head else "I"
    width = struct.calcsize(word)
    offsets = sorted({int(offset) for offset in re.findall(rb'offset="(\d+)"', head)})

    def number(position):
        return struct.unpack_from(word, data, position)[0]

    def block(offset):
        begin = start + offset
        if not raw:
            later = [other for other in offsets if other > offset]
            return data[begin:start + later[0] if later else data.index(b"<", begin)].strip()
        if b"compressor=" not in head:
            return base64.b64encode(data[begin:begin + width + number(begin)])
        blocks = number(begin)
        body = begin + width * (3 + blocks)
        end = body + sum(number(begin + width * (3 + i)) for i in range(blocks))
        return base64.b64encode(data[begin:body]) + base64.b64encode(data[body:end])

    def element(match):
        opening = match.group(1).replace(b'"appended"', b'"binary"')
        return b"%s>\n%s\n</%s>" % (opening, block(int(match.group(3))), match.group(2))

    head = re.sub(rb'(<(\w+)\b[^<>]*?)\s+offset="(\d+)"\s*/>', element, head)
    with open(target, "wb") as stream:
        stream.write(head + b"</VTKFile>\n")
    return True


def open_file(path, q):
    """A reader proxy, all of its arrays switched on."""
    if q:
        reader = pv.PLOT3DReader(FileName=path, QFileName=q, FunctionFileName="")
        reader.Functions = [100]  # density
        return reader
    try:
        reader = pv.OpenDataFile(path)
    except RuntimeError:
        reader = None
    if reader is None:
        return None
    for name in reader.ListProperties():
        selection = reader.GetProperty(name)
        if hasattr(selection, "SelectAll"):
            selection.SelectAll()
    return reader


def update(reader, moment):
    times = list(getattr(reader, "TimestepValues", None) or [])
    if moment is None and times:
        moment = times[-1]
    if moment is None:
        reader.UpdatePipeline()
    else:
        reader.UpdatePipeline(moment)
        pv.GetAnimationScene().AnimationTime = moment
    return moment if len(times) > 1 else None


def read(options, scratch, messages):
    path = os.path.abspath(options.file)
    q = options.q or plot3d_solution(path)
    if q:
        say(f"Reading {path} (PLOT3D, solution in {os.path.basename(q)})")
    else:
        say(f"Reading {path}")
    reader = open_file(path, q)
    if reader is None:
        hint = ""
        if "xyz" in path.lower():
            hint = " If it is a PLOT3D grid, give its solution file with --q."
        raise DemoError(f"ParaView has no reader for '{options.file}'.{hint}")
    moment = update(reader, options.time)
    if empty(reader):
        copy = os.path.join(scratch, os.path.basename(path))
        with open(path, "rb") as stream:
            xml = b"<VTKFile" in stream.read(1000)
        if xml and inline_appended_data(path, copy):
            say("This system's XML library cannot read appended data: reading a re-encoded copy")
            messages.last_error()
            pv.Delete(reader)
            reader = open_file(copy, None)
            moment = update(reader, options.time)
    if empty(reader):
        raise DemoError(f"ParaView finds no data in '{options.file}'. {messages.last_error()}")
    if moment is not None:
        say(f"Time {moment:g}")
    return reader


def empty(source):
    return source.GetDataInformation().GetNumberOfPoints() == 0


def arrays_of(source):
    """(association, name) of each array with one component, points before cells."""
    information = source.GetDataInformation()
    found = []
    for association, attributes in (("POINTS", information.GetPointDataInformation()),
                                    ("CELLS", information.GetCellDataInformation())):
        for index in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArrayInformation(index)
            if array.GetNumberOfComponents() == 1 and not array.GetName().startswith("vtk"):
                found.append((association, array.GetName()))
    return found


def choose_array(source, options):
    arrays = arrays_of(source)
    listing = ", ".join(dict.fromkeys(name for _, name in arrays)) or "none with one component"
    if options.array:
        for association, name in arrays:
            if name == options.array:
                return association, name
        raise DemoError(f"There is no array '{options.array}' in '{options.file}'. "
                        f"Its arrays: {listing}.")
    _, names = MODELS[options.model]
    for wanted in names:
        for association, name in arrays:
            if name.lower() == wanted:
                return association, name
    for association, name in arrays:
        if any(len(wanted) > 2 and wanted in name.lower() for wanted in names):
            return association, name
    raise DemoError(f"No array of '{options.file}' is named like a {names[1]}: choose one with "
                    f"--array. Its arrays: {listing}.")


# ---------------------------------------------------------------------------------------------
# The view that all four pictures share


class Frame:
    """An orthographic view, and how many pixels show it."""

    def __init__(self, bounds, options):
        low, high = np.array(bounds[0::2]), np.array(bounds[1::2])
        extent = high - low
        if extent.min() <= 1e-9 * extent.max():
            raise DemoError(f"'{options.file}' has no thickness along "
                            f"{'xyz'[int(extent.argmin())]}: light needs a volume to pass through. "
                            "Extrude it first.")
        self.direction = np.array(options.view[0], dtype=float)
        up = np.array(options.view[1], dtype=float)
        self.u = np.cross(self.direction, up)
        self.u /= np.linalg.norm(self.u)
        self.v = np.cross(self.u, self.direction)
        self.up = up
        self.center = np.array(options.center) if options.center else (low + high) / 2
        width, height = (np.abs(axis) @ extent for axis in (self.u, self.v))
        self.depth = np.abs(self.direction) @ extent
        if options.size:
            self.width, self.height = options.size
        else:
            pixel = max(width / 880, height / 640)
            self.width, self.height = (max(160, math.ceil(side / pixel))
                                       for side in (width, height))
        self.scale = options.half_height or max(height, width * self.height / self.width) / 2
        self.pixel = 2 * self.scale / self.height
        # How much of the picture the data's box covers (all of it, where it reaches beyond).
        faces = extent[[1, 2, 0]] * extent[[2, 0, 1]]
        self.shadow = min(np.abs(self.direction) @ faces,
                          self.width * self.height * self.pixel ** 2)
        # Picture coordinates of the left, right, bottom and top edges.
        middle = np.array([self.center @ self.u, self.center @ self.v])
        half = np.array([self.width, self.height]) * self.pixel / 2
        (self.left, self.bottom), (self.right, self.top) = middle - half, middle + half

    def axis_name(self, axis):
        for index, letter in enumerate("xyz"):
            if abs(axis[index]) > 1 - 1e-9:
                return letter if axis[index] > 0 else "-" + letter
        return "u" if axis is self.u else "v"


# ---------------------------------------------------------------------------------------------
# The four pictures, each a numpy array of frame.height rows (bottom row first)


def configure(proxy, reader, array, options):
    """What RefractiveIndex and Schlieren have in common: what the index of refraction is."""
    proxy.IndexModel = options.model
    setattr(proxy, MODELS[options.model][0], list(array))
    proxy.GladstoneDaleConstant = options.constant
    proxy.DensityScale = options.density_scale
    for name, value in options.settings:
        if name in proxy.ListProperties():
            setattr(proxy, name, value)


def output_of(proxy, what, messages):
    proxy.UpdatePipeline()
    image = servermanager.Fetch(proxy)
    if image is None or image.GetNumberOfPoints() == 0:
        raise DemoError(f"The {what} failed. {messages.last_error()}")
    return image


class Progress:
    """Says every few seconds how far a long computation has come."""

    def __init__(self, proxy):
        self.last = time.monotonic()
        proxy.GetClientSideObject().AddObserver("ProgressEvent", self)

    def __call__(self, algorithm, event):
        if time.monotonic() - self.last > 5 and 0 < algorithm.GetProgress() < 1:
            say(f"  {algorithm.GetProgress():.0%}")
            self.last = time.monotonic()


def bench_pictures(reader, array, frame, options, messages):
    """Vertical knife edge, horizontal knife edge and shadowgraph, from one tracing of the rays."""
    schlieren = pv.Schlieren(Input=reader)
    configure(schlieren, reader, array, options)
    schlieren.LengthScale = options.length_scale
    schlieren.ViewDirection = list(frame.direction)
    schlieren.ViewUp = list(frame.up)
    schlieren.FocalPoint = list(frame.center)
    schlieren.ParallelScale = frame.scale
    schlieren.ImageSize = [frame.width, frame.height]
    for name, value in options.settings:
        if name not in schlieren.ListProperties():
            raise DemoError(f"The Schlieren filter has no property '{name}'. "
                            f"It has: {', '.join(schlieren.ListProperties())}.")
        setattr(schlieren, name, value)

    progress = Progress(schlieren)
    pictures = []
    for name, cutoff, angle in (("vertical knife edge", "Knife Edge", 0),
                                ("horizontal knife edge", "Knife Edge", 90),
                                ("shadowgraph", "Shadowgraph", 0)):
        begin = time.monotonic()
        schlieren.Cutoff = cutoff
        schlieren.KnifeEdgeAngle = angle
        image = output_of(schlieren, name, messages)
        arrays = image.GetPointData()
        intensity = vtk_to_numpy(arrays.GetArray("Intensity"))
        blocked = vtk_to_numpy(arrays.GetArray("BlockedFraction")).sum() * frame.pixel ** 2
        facts = {}
        for index in range(image.GetFieldData().GetNumberOfArrays()):
            field = image.GetFieldData().GetAbstractArray(index)
            facts[field.GetName()] = field.GetValue(0)
        pictures.append((intensity.reshape(frame.height, frame.width).copy(), facts))
        say(f"{name.capitalize()}: {time.monotonic() - begin:.1f} s")
    share = blocked / frame.shadow
    if share > 0.99:
        raise DemoError("No light comes through: on every way there is a place that is solid or "
                        "that no cell covers. Choose another --view.")
    if share > 0.1:
        say(f"{share:.0%} of the light is blocked: by solids, or by places that no cell covers")
    return pictures


def refractivity(reader, array, clear, options, messages):
    """n - 1 on a regular grid, as the tracer sees it; solids get the value that will be clear."""
    proxy = pv.RefractiveIndex(Input=reader)
    configure(proxy, reader, array, options)
    fetched = output_of(proxy, "computation of the refractive index", messages)
    image = vtkImageData()
    image.ShallowCopy(fetched)
    values = vtk_to_numpy(image.GetPointData().GetArray("Refractivity")).astype(np.float32)
    solid = vtk_to_numpy(image.GetPointData().GetArray("vtkValidPointMask")) == 0
    low, high = float(values[~solid].min()), float(values[~solid].max())
    values[solid] = clear
    clean = numpy_to_vtk(values, deep=True)
    clean.SetName("Refractivity")
    image.GetPointData().Initialize()
    image.GetPointData().SetScalars(clean)
    return image, low, clear, high


def volume_rendering(medium, frame):
    """Blue where the index is below that of the surroundings, orange to red where it is above."""
    image, low, clear, high = medium
    producer = pv.TrivialProducer()
    producer.GetClientSideObject().SetOutput(image)
    producer.UpdatePipeline()

    view = pv.CreateView("RenderView")
    view.ViewSize = [frame.width, frame.height]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0.05, 0.06, 0.08]
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = list(frame.center)
    view.CameraPosition = list(frame.center - 4 * (frame.depth + frame.scale) * frame.direction)
    view.CameraViewUp = list(frame.up)
    view.CameraParallelScale = frame.scale

    representation = pv.Show(producer, view)
    representation.SetRepresentationType("Volume")
    pv.ColorBy(representation, ("POINTS", "Refractivity"))
    representation.SetScalarBarVisibility(view, False)
    color = pv.GetColorTransferFunction("Refractivity")
    opacity = pv.GetOpacityTransferFunction("Refractivity")
    # Away from the clear value, as a share of the way to the extreme: colour and opacity.
    below = ((1.0, (0.15, 0.40, 1.0), 0.90), (0.6, (0.40, 0.70, 1.0), 0.45),
             (0.15, (0.75, 0.90, 1.0), 0.06), (0.03, (0.9, 0.9, 0.9), 0))
    above = ((0.03, (0.9, 0.9, 0.9), 0), (0.12, (1.0, 0.85, 0.55), 0.08),
             (0.4, (1.0, 0.60, 0.20), 0.30), (1.0, (1.0, 0.12, 0.08), 0.80))
    reach = max(high - clear, clear - low, 1e-30)

    def side(extreme, steps):
        span = abs(extreme - clear)
        # A side that hardly departs from the clear value is noise: keep it transparent.
        visible = span > 0.02 * reach
        span = span if visible else reach
        sign = -1 if steps is below else 1
        return [(clear + sign * share * span, rgb, alpha if visible else 0)
                for share, rgb, alpha in steps]

    points = side(low, below) + side(high, above)
    color.ColorSpace = "RGB"
    color.RGBPoints = [number for value, rgb, _ in points for number in (value, *rgb)]
    opacity.Points = [number for value, _, alpha in points for number in (value, alpha, 0.5, 0.0)]
    representation.ScalarOpacityUnitDistance = frame.depth / 8

    with tempfile.NamedTemporaryFile(suffix=".png") as shot:
        pv.SaveScreenshot(shot.name, view, ImageResolution=[frame.width, frame.height])
        reader = vtkPNGReader()
        reader.SetFileName(shot.name)
        reader.Update()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        pixels = pixels.reshape(frame.height, frame.width, -1)[..., :3].copy()
    pv.Delete(view)
    pv.Delete(producer)
    return pixels


def grey(intensity, white):
    """A pixel of the result for a pixel of the film: nothing is resampled."""
    share = np.clip(np.nan_to_num(intensity) / white, 0, 1)
    return np.repeat(np.rint(255 * share).astype(np.uint8)[..., None], 3, axis=2)


# ---------------------------------------------------------------------------------------------
# The sheet: four pictures with titles and axes. Row 0 is the top one here.


class Sheet:
    BACKGROUND = (24, 26, 31)
    FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
    BRIGHT, DIM = (240, 240, 240), (165, 172, 182)

    def __init__(self, width, height):
        self.pixels = np.full((height, width, 3), self.BACKGROUND, np.uint8)

    def paste(self, left, top, tile):
        self.pixels[top:top + tile.shape[0], left:left + tile.shape[1]] = tile

    def fill(self, left, top, width, height, color):
        self.pixels[max(top, 0):top + height, max(left, 0):left + width] = color

    def text(self, left, top, string, points, color=BRIGHT, anchor="left", room=None):
        """Draws a line of text; made smaller until it fits into `room` pixels."""
        image, dimensions = vtkImageData(), [0, 0]
        while True:
            style = vtkTextProperty()
            if os.path.isfile(self.FONT):
                style.SetFontFamily(4)  # VTK_FONT_FILE
                style.SetFontFile(self.FONT)
            style.SetFontSize(points)
            style.SetColor(1, 1, 1)
            vtkTextRenderer.GetInstance().RenderString(style, string, image, dimensions, 72)
            columns, rows, _ = image.GetDimensions()
            if room is None or dimensions[0] <= room or points <= 8:
                break
            points -= 1
        ink = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1)
        ink = ink[:dimensions[1], :dimensions[0], 3][::-1] / 255
        left -= {"left": 0, "middle": ink.shape[1] // 2, "right": ink.shape[1]}[anchor]
        left, top = max(left, 0), max(top, 0)
        place = self.pixels[top:top + ink.shape[0], left:left + ink.shape[1]]
        ink = ink[:place.shape[0], :place.shape[1], None]
        place[:] = np.rint(place * (1 - ink) + np.array(color) * ink).astype(np.uint8)

    def write(self, path):
        height, width, _ = self.pixels.shape
        image = vtkImageData()
        image.SetDimensions(width, height, 1)
        image.GetPointData().SetScalars(
            numpy_to_vtk(np.ascontiguousarray(self.pixels[::-1]).reshape(-1, 3), deep=True))
        writer = vtkPNGWriter()
        writer.SetFileName(path)
        writer.SetInputData(image)
        writer.Write()
        if not os.path.isfile(path) or writer.GetErrorCode():
            raise DemoError(f"Could not write '{path}'.")


def length_unit(metres):
    for name, factor in (("km", 1e3), ("m", 1), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9)):
        if metres >= factor:
            return name, factor
    return "m", 1


def round_step(span, wanted):
    """A step of 1, 2 or 5 times a power of ten that divides `span` into about `wanted` parts."""
    rough = span / wanted
    power = 10 ** math.floor(math.log10(rough))
    return power * min((1, 2, 5, 10), key=lambda digit: abs(math.log(digit * power / rough)))


def draw_axes(sheet, left, top, frame, options):
    """Ticks below and to the left of a picture, in round steps of a unit of length."""
    extent = max(frame.right - frame.left, frame.top - frame.bottom) * options.length_scale
    unit, metres = length_unit(extent)
    scale = options.length_scale / metres
    bottom = top + frame.height

    def ticks(low, pixels):
        """(label, pixel) pairs. Pixel i reaches from low + i pixel to low + (i + 1) pixel."""
        step = round_step(pixels * frame.pixel * scale, max(3, pixels / 110))
        first = math.ceil(low * scale / step - 1e-6)
        last = math.floor((low + pixels * frame.pixel) * scale / step + 1e-6)
        for index in range(first, last + 1):
            place = math.floor((index * step / scale - low) / frame.pixel)
            yield f"{index * step:.10g}", min(max(place, 0), pixels - 1)

    for label, column in ticks(frame.left, frame.width):
        sheet.fill(left + column, bottom, 1, 5, sheet.DIM)
        sheet.text(left + column, bottom + 7, label, 13, sheet.DIM, "middle")
    for label, row in ticks(frame.bottom, frame.height):
        sheet.fill(left - 5, bottom - 1 - row, 5, 1, sheet.DIM)
        sheet.text(left - 8, bottom - 8 - row, label, 13, sheet.DIM, "right")
    sheet.text(left + frame.width, bottom + 22, f"{frame.axis_name(frame.u)} / {unit}", 13,
               sheet.DIM, "right")
    sheet.text(left - 8, top - 20, f"{frame.axis_name(frame.v)} / {unit}", 13, sheet.DIM, "right")


def format_length(data_units, options):
    metres = data_units * options.length_scale
    unit, factor = length_unit(abs(metres) * 1.0001)
    return f"{metres / factor:.3g} {unit}"


def layout(frame):
    """The sheet's width and height, the upper left corners of its pictures, a column's width."""
    margin, head, foot, above, below = 64, 62, 30, 84, 48
    column = max(frame.width, 560) + margin
    row = above + frame.height + below
    corners = [(margin + i * column, head + j * row + above) for j in (0, 1) for i in (0, 1)]
    return 2 * column + 24, head + 2 * row + foot, corners, column


def compose(volume, medium, pictures, frame, array, options):
    (vertical, facts), (horizontal, _), (shadow, _) = pictures
    k = facts["KScale"]
    _, low, clear, high = medium
    distance = dict(options.settings).get("ScreenDistance", -1)
    distance = frame.depth if distance < 0 else distance
    ends = f"k = {k:.4g}"
    if k > 0:
        ends += f": black to white is {-0.5 / k:.2g} to {0.5 / k:.2g} rad"
    tiles = [
        (volume, "Volume rendering",
         f"n - 1 = {low:.3g} (blue) to {high:.3g} (red), clear at {clear:.3g}"),
        (grey(vertical, 1), "Schlieren, vertical knife edge",
         f"Bright: light deflected to the right. {ends}"),
        (grey(horizontal, 1), "Schlieren, horizontal knife edge",
         f"Bright: light deflected upwards. {ends}"),
        (grey(shadow, 2), "Shadowgraph",
         f"Screen {format_length(distance, options)} behind the flow; black to white is 0 to 2 "
         "times the undisturbed light"),
    ]
    width, height, corners, column = layout(frame)
    sheet = Sheet(width, height)
    room = width - 48
    law = {"Gladstone-Dale": f"n - 1 = {options.constant:g} m³/kg x density",
           "Refractive Index": "The array is n",
           "Refractivity": "The array is n - 1"}[options.model]
    if options.model == "Gladstone-Dale" and options.density_scale != 1:
        law += f" ({options.density_scale:g} kg/m³ for 1)"
    sheet.text(24, 14, f"{os.path.basename(options.file)}: {array[1]}", 26, room=room)
    looking = ", ".join(f"{part + 0.0:.3g}" for part in frame.direction)
    sheet.text(24, 44, f"Looking along ({looking}) through {format_length(frame.depth, options)}.  "
               f"{law}.", 15, sheet.DIM, room=room)
    for (left, top), (tile, title, line) in zip(corners, tiles):
        sheet.text(left, top - 66, title, 20, room=column - 48)
        sheet.text(left, top - 40, line, 15, sheet.DIM, room=column - 48)
        sheet.paste(left, top, tile[::-1])
        draw_axes(sheet, left, top, frame, options)
    sheet.text(width - 24, height - 26,
               f"{int(facts['RaysTraced']):,} rays, {int(facts['StepsTaken']):,} steps, traced on the "
               f"{facts['Device']}", 13, sheet.DIM, "right")
    return sheet


# ---------------------------------------------------------------------------------------------


def main(options):
    messages = Messages()
    if not options.plugin:
        raise DemoError("Which plugin? Give its file with --plugin, or start Utilities/demo.")
    try:
        pv.LoadPlugin(os.path.abspath(options.plugin), remote=False)
    except RuntimeError:
        pass
    if not hasattr(pv, "Schlieren"):
        raise DemoError(f"The plugin '{options.plugin}' does not load. {messages.last_error()}")
    with tempfile.TemporaryDirectory() as scratch:
        reader = read(options, scratch, messages)
        array = choose_array(reader, options)
        if not options.array:
            say(f"Using the array '{array[1]}'")
        frame = Frame(reader.GetDataInformation().GetBounds(), options)
        say(f"Tracing rays, {frame.width} x {frame.height} pixels")
        pictures = bench_pictures(reader, array, frame, options, messages)
        begin = time.monotonic()
        clear = pictures[0][1]["AmbientRefractivity"]
        medium = refractivity(reader, array, clear, options, messages)
        volume = volume_rendering(medium, frame)
        say(f"Volume rendering: {time.monotonic() - begin:.1f} s")
        compose(volume, medium, pictures, frame, array, options).write(options.output)
    say(f"The picture: {os.path.abspath(options.output)}")


if __name__ == "__main__":
    try:
        main(OPTIONS)
    except DemoError as problem:
        print(f"error: {' '.join(str(problem).split())}", file=sys.stderr)
        sys.exit(1)
