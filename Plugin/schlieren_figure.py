# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Figures of schlieren images, with axes in units of length and a legend.

    import schlieren_figure                         # once the plugin is loaded
    schlieren_figure.save("jet.pdf", schlieren)     # or .png or .svg

Sheet draws them, and all sheets of the demo.
"""

import json
import math
import os
from contextlib import contextmanager

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle
from paraview import servermanager, simple
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow
from vtkmodules.vtkImagingCore import vtkExtractVOI

ENDINGS = (".png", ".pdf", ".svg")

# Properties of the camera and the size, which displays have of their view.
OF_THE_VIEW = ("ViewDirection", "ViewUp", "FocalPoint", "ParallelScale", "ViewAngle", "SensorWidth", "ImageSize")


class FigureError(RuntimeError):
    """Something the user can put right. The text says what, why and how."""


@contextmanager
def writing(path):
    """Says which file cannot be written."""
    try:
        yield
    except OSError as problem:
        raise FigureError(f"Could not write '{path}': {problem.strerror}.") from problem


def prefix_of(value):
    """The prefix of a unit in which a value has one to three digits before the point, and its factor; milli for 0."""
    for prefix, factor in (("k", 1e3), ("", 1), ("m", 1e-3), ("µ", 1e-6)):
        if abs(value) >= factor:
            return prefix, factor
    return ("n", 1e-9) if value else ("m", 1e-3)


def axis_name(axis, otherwise):
    """The name of a direction in the data, of that it is along an axis; else `otherwise`."""
    for letter, part in zip("xyz", axis):
        if abs(part) > 1 - 1e-9:
            return letter if part > 0 else "-" + letter
    return otherwise


def facts_of(image):
    """The field data of a vtkImageData: lists by name."""
    data = image.GetFieldData()
    arrays = [data.GetAbstractArray(index) for index in range(data.GetNumberOfArrays())]
    return {array.GetName(): [array.GetVariantValue(i).ToString() if array.IsA("vtkStringArray") else
                              array.GetVariantValue(i).ToDouble() for i in range(array.GetNumberOfValues())]
            for array in arrays}


def rows_of(image, name):
    """A point array as rows x columns (x components), the lowest row first."""
    columns, rows, _ = image.GetDimensions()
    values = vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(rows, columns, -1)
    return values[..., 0] if values.shape[2] == 1 else values


def grey(intensity, white=1):
    """A pixel of a figure for a pixel of the film, rows x columns x 3 bytes: black is 0."""
    level = np.clip(np.nan_to_num(intensity) / white, 0, 1)
    return np.repeat(np.rint(255 * level).astype(np.uint8)[..., None], 3, axis=2)


def pixels_of(image):
    """An image as views show it, rows x columns x 3 bytes, the lowest row first."""
    if image.GetPointData().HasArray("Color"):
        return rows_of(image, "Color")
    return grey(rows_of(image, "Intensity"), facts_of(image)["WhiteLevel"][0])


def cropped(image):
    """The smallest rectangle of an image that has all light through the data, and what it blocks."""
    path, blocked = rows_of(image, "OpticalPathDifference"), rows_of(image, "BlockedFraction")
    covered = (path != 0) | (blocked > 0)
    if not covered.any():
        return image
    extract = vtkExtractVOI()
    extract.SetInputData(image)
    first, last = zip(*((found[0], found[-1]) for found in (np.flatnonzero(covered.any(axis=axis)) for axis in (0, 1))))
    extract.SetVOI(first[0], last[0], first[1], last[1], 0, 0)
    extract.Update()
    return extract.GetOutput()


class Axes:
    """The place of an image's edges, in a unit that suits it, and the names of its axes."""

    def __init__(self, left, bottom, pixel, size, names, length_scale):
        """`left`, `bottom`, `pixel`: data units; `size`: columns, rows; `length_scale`: metres for 1."""
        prefix, factor = prefix_of(max(size) * pixel * length_scale)
        self.unit, scale = prefix + "m", length_scale / factor
        self.left, self.bottom = left * scale, bottom * scale
        self.right, self.top = self.left + size[0] * pixel * scale, self.bottom + size[1] * pixel * scale
        self.names = names

    @classmethod
    def of(cls, image, facts):
        pixel = image.GetSpacing()[0]
        left, bottom = (image.GetBounds()[2 * i] - pixel / 2 for i in (0, 1))
        return cls(left, bottom, pixel, image.GetDimensions()[:2],
                   (axis_name(facts["AxisRight"], "u"), axis_name(facts["AxisUp"], "v")), facts["LengthScale"][0])


class Sheet:
    """A page with images on it, pixel by pixel. Lengths are in hundredths of an inch, places from the upper left."""

    FONT = "DejaVu Sans"
    DARK, DIM, BORDER = "#111111", "#555b66", "#b0b4ba"

    def __init__(self, width, height, zoom=1):
        """`zoom`: pixels of the page for a hundredth of an inch."""
        self.width, self.height, self.zoom = width, height, zoom
        self.figure = Figure(figsize=(width / 100, height / 100), dpi=100 * zoom, facecolor="white")
        self.canvas = FigureCanvasAgg(self.figure)
        self.images = []  # left, top (pixels of the page) and pixels of each

    def box(self, left, top, width, height):
        return [left / self.width, 1 - (top + height) / self.height, width / self.width, height / self.height]

    def fill(self, left, top, width, height, color):
        x, y, across, up = self.box(left, top, width, height)
        self.figure.add_artist(Rectangle((x, y), across, up, color=color, lw=0, zorder=-1))

    def text(self, left, top, string, size, color=DARK, anchor="left", room=None):
        """A line of text, `size` high; made smaller until it fits into `room`."""
        drawn = self.figure.text(left / self.width, 1 - top / self.height, string.replace("$", r"\$"), color=color,
                                 fontsize=0.72 * size, family=self.FONT, va="top",
                                 ha="center" if anchor == "middle" else anchor)
        if room:
            wide = drawn.get_window_extent(self.canvas.get_renderer()).width / self.zoom
            drawn.set_fontsize(0.72 * max(6, size * min(1, room / max(wide, 1))))

    def image(self, left, top, pixels, axes=None, repeat=1):
        """An image (rows x columns x 3 bytes, the lowest row first), each pixel `repeat` pixels of the page wide."""
        rows, columns = pixels.shape[:2]
        width, height = (count * repeat / self.zoom for count in (columns, rows))
        self.fill(left - 1, top - 1, width + 2, height + 2, self.BORDER)
        self.images.append((round(left * self.zoom), round(top * self.zoom),
                            pixels[::-1].repeat(repeat, axis=0).repeat(repeat, axis=1)))
        frame = self.figure.add_axes(self.box(left, top, width, height))
        extent = (axes.left, axes.right, axes.bottom, axes.top) if axes else (0, columns, 0, rows)
        frame.imshow(pixels, origin="lower", extent=extent, aspect="auto", interpolation="none")
        for spine in frame.spines.values():
            spine.set_visible(False)
        if not axes:
            frame.set_xticks([])
            frame.set_yticks([])
            return
        for axis, length in ((frame.xaxis, width), (frame.yaxis, height)):
            axis.get_major_locator().set_params(nbins=max(2, round(length / 80)), steps=[1, 2, 5, 10])
        frame.tick_params(labelsize=0.72 * 13, colors=self.DIM, width=0.72, length=3)
        for label in frame.get_xticklabels() + frame.get_yticklabels():
            label.set_family(self.FONT)
        self.text(left + width, top + height + 22, f"{axes.names[0]} / {axes.unit}", 13, self.DIM, "right")
        self.text(left - 6, top - 20, f"{axes.names[1]} / {axes.unit}", 13, self.DIM, "right")

    LEGEND_HEIGHT, PLANE_HEIGHT = 64, 150

    def legend_height(self, facts):
        return self.PLANE_HEIGHT if facts["LegendSize"][1] > 1 else self.LEGEND_HEIGHT

    def legend(self, left, top, facts, room, light=None):
        """What the light of an image stands for, of its field data: the stop, a scale, and notes. `light`: another note."""
        label, unit = facts["LegendLabel"]
        columns, rows = (int(count) for count in facts["LegendSize"])
        first, last = facts["LegendRange"]
        prefix, factor = prefix_of(max(abs(first), abs(last))) if unit else ("", 1)
        name = label + (f", {prefix}{unit}" if unit else "")
        notes = ", ".join(facts.get("LegendNotes", []) + ([light] if light else []))
        indent = 0
        if columns and rows == 1 and unit == "rad":
            self.stop(left, top + 2, facts)
            indent = 50
        self.text(left + indent, top, "   ".join(filter(None, (name, notes))), 13, self.DIM, room=room - indent)
        if not columns:
            return
        colors = np.array(facts["LegendColors"]).reshape(rows, columns, 3).astype(np.uint8)
        width, height = (90, 90) if rows > 1 else (min(300, room - indent - 20), 14)
        scale = self.figure.add_axes(self.box(left + indent + (50 if rows > 1 else 12), top + 20, width, height))
        low, high = first / factor, last / factor
        scale.imshow(colors, origin="lower", aspect="auto", interpolation="none",
                     extent=(low, high, low, high) if rows > 1 else (low, high, 0, 1))
        scale.tick_params(labelsize=0.72 * 12, colors=self.DIM, width=0.72, length=3)
        scale.xaxis.get_major_locator().set_params(nbins=4, steps=[1, 2, 5, 10])
        if rows > 1:
            scale.yaxis.get_major_locator().set_params(nbins=4, steps=[1, 2, 5, 10])
        else:
            scale.set_yticks([])

    def stop(self, left, top, facts):
        """The image of the light source, and the side of it that the stop covers."""
        side = 36
        icon = self.figure.add_axes(self.box(left, top, side, side), xlim=(-1, 1), ylim=(-1, 1))
        icon.set_axis_off()
        icon.add_patch(Rectangle((-1, -1), 2, 2, color="black", lw=0))
        colors = np.array(facts["LegendColors"]).reshape(-1, 3)
        is_dark_first = colors[0, 1] < colors[-1, 1]
        if "LegendAngle" in facts:
            icon.add_patch(Circle((0, 0), 0.6, color="white", lw=0))
            angle = facts["LegendAngle"][0] + (180 if is_dark_first else 0)
            icon.add_patch(Rectangle((0, -2), 2, 4, angle=angle, rotation_point=(0, 0), color="#808080", lw=0))
        else:
            inner, outer = ("#808080", "white") if is_dark_first else ("white", "#808080")
            icon.add_patch(Circle((0, 0), 0.9, color=outer, lw=0))
            icon.add_patch(Circle((0, 0), 0.4, color=inner, lw=0))

    def drawn(self):
        """The page, rows x columns x 3 bytes, the uppermost row first. Matplotlib rounds the edges of images to other
        pixels than these, so they are copied."""
        self.canvas.draw()
        page = np.array(self.canvas.buffer_rgba())[..., :3]
        for left, top, pixels in self.images:
            page[top:top + pixels.shape[0], left:left + pixels.shape[1]] = pixels
        return np.ascontiguousarray(page)

    def write(self, path, dpi=None):
        """Writes the page as its file's name says: .png, .pdf or .svg. `dpi`: of a .png, default: that of its texts."""
        with writing(path):
            if path.lower().endswith(".png"):
                Image.fromarray(self.drawn()).save(path, dpi=2 * (dpi or 100 * self.zoom,))
            else:
                with rc_context({"svg.fonttype": "none", "pdf.fonttype": 42}):  # texts stay texts
                    self.figure.savefig(path)


def filter_like(display, view, size=None):
    """A Schlieren filter (not in the pipeline browser) whose image is that of a display that draws a flow as Schlieren.

    size: columns and rows, default: those of the view."""
    own = display.SchlierenBench
    bench = servermanager.filters.Schlieren(Input=display.Input)
    for name in bench.ListProperties():
        if name not in OF_THE_VIEW and name != "Input" and not own.GetProperty(name).SMProperty.GetInformationOnly():
            bench.SMProxy.GetProperty(name).Copy(own.SMProxy.GetProperty(name))
    camera = view.GetActiveCamera()
    angle = 0 if camera.GetParallelProjection() else camera.GetViewAngle()
    half = math.tan(math.radians(angle / 2)) * camera.GetDistance() if angle else camera.GetParallelScale()
    bench.ViewDirection, bench.ViewUp = list(camera.GetDirectionOfProjection()), list(camera.GetViewUp())
    bench.FocalPoint, bench.ParallelScale, bench.ViewAngle = list(camera.GetFocalPoint()), half, angle
    if angle and camera.GetFocalDistance() > 0 and camera.GetFocalDisk() > 0:  # the view's camera has a lens
        bench.FNumber = bench.LensFocalLength / (1e3 * camera.GetFocalDisk() * bench.LengthScale)
        bench.FocusDistance = camera.GetFocalDistance()
    bench.ImageSize = list(size or view.ViewSize)
    bench.SMProxy.UpdateVTKObjects()
    return bench


def displays_in(view):
    """What a view draws as Schlieren."""
    return [shown for shown in getattr(view, "Representations", []) if shown.GetProperty("SchlierenBench") is not None
            and shown.Visibility and shown.Representation == "Schlieren"]


IMAGES = ("Schlieren", "CompareWithPhotograph")


def filters_in(view):
    """The Schlieren filters, and comparisons with a photograph, whose images a view shows."""
    return [shown.Input for shown in getattr(view, "Representations", [])
            if shown.Visibility and getattr(shown, "Input", None) is not None and shown.Input.GetXMLName() in IMAGES]


def chosen(view, size):
    """The filter of the image that is meant where none is named: of what the view draws as Schlieren, the selected
    one, or one whose image the view shows."""
    source = simple.GetActiveSource()
    for display in displays_in(view):
        return filter_like(display, view, size)
    if source is not None and source.GetXMLName() in IMAGES:
        return source
    for shown in filters_in(view):
        return shown
    raise FigureError("There is no schlieren image to save. Click into a view that shows one, or select a filter "
                      "Schlieren in the Pipeline Browser.")


def light_of(bench):
    """Which light makes an image, in words."""
    while bench.GetXMLName() != "Schlieren":  # a comparison with a photograph
        bench = bench.Input
    are_waves = bench.Cutoff == "Phase Contrast" or bench.LightModel == "Waves"
    return f"{'waves' if are_waves else 'rays'} of {bench.Wavelength:g} nm"


def time_of(bench):
    """The time of the data that a filter's image shows; None where these have none."""
    information = bench.SMProxy.GetDataInformation(0)
    return information.GetTime() if information.GetHasTime() else None


@contextmanager
def keeping(time):
    """Has the session's time be that of an image."""
    keeper = simple.GetTimeKeeper()
    before = keeper.Time
    keeper.Time = before if time is None else time
    try:
        yield
    finally:
        keeper.Time = before


def sheet_of(image, title="", light=None):
    """A page with one image, each of its pixels one pixel of the page, or some where there are few. Of a comparison with a
    photograph both, side by side."""
    facts = facts_of(image)
    both = {name: grey(rows_of(image, name)) for name in ("Photograph", "Simulated") if image.GetPointData().HasArray(name)}
    images = both or {"": pixels_of(image)}
    rows, columns = next(iter(images.values())).shape[:2]
    repeat = max(1, math.ceil(480 / columns))
    zoom = max(1, round(columns * repeat / 800))
    width, height = columns * repeat / zoom, rows * repeat / zoom
    left, top = 70, 88 if both else 64
    step = left + math.ceil(width + 24)
    sheet = Sheet(step * len(images), 1, zoom)
    below = sheet.legend_height(facts)
    sheet = Sheet(sheet.width, math.ceil(top + height + 48 + below), zoom)
    sheet.text(left, 10, title or facts["LegendTitle"][0], 20, room=width)
    for place, (name, pixels) in enumerate(images.items()):
        sheet.text(left + step * place, 38, name, 13, sheet.DIM)
        sheet.image(left + step * place, top, pixels, Axes.of(image, facts), repeat)
    sheet.legend(left, math.ceil(top + height + 46), facts, step * (len(images) - 1) + width, light)
    return sheet


def write_numbers(paths, image):
    """The intensities in 16 bits as a PNG and a TIFF; 0 is black, the field data's WhiteLevel is 65535."""
    white = facts_of(image)["WhiteLevel"][0]
    numbers = np.clip(np.nan_to_num(rows_of(image, "Intensity")) / white, 0, 1)
    pixels = np.rint(65535 * numbers[::-1]).astype(np.uint16)
    for path in paths:
        with writing(path):
            Image.fromarray(pixels).save(path)


def plain(value):
    """A value of a property as JSON can hold it."""
    if isinstance(value, servermanager.EnumerationProperty):
        return value.GetData()
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, servermanager.Proxy) and hasattr(value, "Points"):  # a curve
        return list(value.Points)
    if isinstance(value, servermanager.Proxy):
        return value.GetXMLName()
    return [plain(item) for item in value]


def properties_of(proxy):
    names = [name for name in sorted(proxy.ListProperties()) if name != "Input"]
    return {name: plain(proxy.GetPropertyValue(name)) for name in names
            if not proxy.GetProperty(name).SMProperty.GetInformationOnly()
            and proxy.GetProperty(name).SMProperty.GetClassName() != "vtkSMProperty"}  # a command


def sources_of(proxy):
    """What is above a filter in the pipeline, the first sources first: type and properties of each."""
    inputs = proxy.SMProxy.GetProperty("Input")
    found = []
    for index in range(inputs.GetNumberOfProxies() if inputs else 0):
        source = servermanager._getPyProxy(inputs.GetProxy(index))  # pylint: disable=protected-access
        found += sources_of(source) + [{"type": source.GetXMLName(), "properties": properties_of(source)}]
    return found


def versions(facts):
    return {"Schlieren": facts["SchlierenVersion"][0],
            "ParaView": servermanager.vtkSMProxyManager.GetProxyManager().GetParaViewSourceVersion()}


def write_description(path, image, bench, title, files):
    facts = facts_of(image)
    axes = Axes.of(image, facts)
    description = {
        "title": title or facts["LegendTitle"][0],
        "files": files,
        "versions": versions(facts),
        "time": time_of(bench),
        "technique": facts["LegendTitle"][0],
        "light": light_of(bench),
        "legend": {"label": facts["LegendLabel"][0], "unit": facts["LegendLabel"][1], "range": facts["LegendRange"],
                   "notes": facts.get("LegendNotes", [])},
        "axes": {"unit": axes.unit, "left": axes.left, "right": axes.right, "bottom": axes.bottom, "top": axes.top,
                 "names": list(axes.names)},
        "numbers": {"array": "Intensity", "black": 0, "white": facts["WhiteLevel"][0]},
        "k": facts["KScale"][0],
        "sources": sources_of(bench),
        "properties": properties_of(bench),
    }
    with writing(path), open(path, "w", encoding="utf-8") as file:
        json.dump(description, file, indent=2, ensure_ascii=False)


def save(filename, image=None, view=None, title="", size=None, dpi=None, crop=False):
    """Saves a figure of a schlieren image, and beside it its numbers and what made it.

    filename: .png (pixel by pixel), .pdf or .svg.
    image: a Schlieren filter, or its comparison with a photograph. Default: that of what `view` draws as Schlieren, the one that is selected in the pipeline
        browser, or one whose image `view` shows.
    view: a render view, default: the active one.
    title: default: the technique.
    size: columns and rows of the image of a flow that a view draws as Schlieren; default: the view's.
    dpi: pixels per inch that a .png says of itself; default: 100 for each 800 pixels of its width.
    crop: leaves out what is beside all light through the data.

    Returns the names of the files: the figure; NAME_intensity.png and .tif, 16 bits, where 65535 is white; NAME.json with the
    settings; NAME.pvsm, a state that makes the image again. FigureError where there is no image."""
    base, ending = os.path.splitext(filename)
    if ending.lower() not in ENDINGS:
        raise FigureError(f"Cannot write '{filename}': name it *.png, *.pdf or *.svg.")
    bench = image or chosen(view or simple.GetActiveView(), size)
    bench.UpdatePipeline()
    made = servermanager.Fetch(bench)
    if made is None or made.GetNumberOfPoints() == 0:
        raise FigureError("The image could not be made: see the message about its filter.")
    if crop:
        made = cropped(made)
    files = [filename] + [base + ending for ending in ("_intensity.png", "_intensity.tif", ".json", ".pvsm")]
    sheet_of(made, title, light_of(bench)).write(filename, dpi)
    write_numbers(files[1:3], made)
    write_description(files[3], made, bench, title, [os.path.basename(name) for name in files])
    with keeping(time_of(bench)):
        simple.SaveState(files[4])
    return files


def save_in_window(filename, **options):
    """Saves a figure of what the active view of the window shows; a mistake is a message. `options`: as of save()."""
    try:
        save(filename, **options)
    except (FigureError, OSError) as problem:
        vtkOutputWindow.GetInstance().DisplayErrorText(f"The figure was not saved. {problem}\n")
