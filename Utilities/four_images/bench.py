# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin, the flow that the user names, and a bench that looks at it."""

import os

import numpy as np
import paraview.simple as pv
from paraview import servermanager

from arguments import MODELS, VIEWS, DemoError
from messages import say
from reading import choose_array, evaluate, listing, read


def load_plugin(options, messages):
    """Loads the plugin that the options name, else that of the package paraview-schlieren."""
    try:
        if options.plugin:
            pv.LoadPlugin(os.path.abspath(options.plugin), remote=False)
        else:
            pv.LoadDistributedPlugin("Schlieren", remote=False)
    except RuntimeError:
        pass
    if not hasattr(pv, "Schlieren"):
        if not options.plugin:
            raise DemoError("Which plugin? The package paraview-schlieren is not installed. Give the plugin's file with "
                            "--plugin, or start Utilities/demo.")
        raise DemoError(f"The plugin '{options.plugin}' does not load. {messages.last_error()}")


def open_flow(options, scratch, messages):
    """A source; its array for the index of refraction, or None where the filter chooses; and that in words."""
    reader = read(options, scratch, messages)
    if options.formula:
        reader, array = evaluate(reader, options, messages)
        return reader, array, options.formula
    array = choose_array(reader, options)
    if array:
        return reader, array, array[1]
    proxy = new_medium(reader, None, options)
    proxy.UpdatePipeline()  # it chooses the arrays
    proxy.UpdatePropertyInformation()
    used = proxy.GetProperty("ArraysUsed").GetData()
    pv.Delete(proxy)
    if not used:
        raise DemoError(f"No array of '{options.file}' is named like what gives an index of refraction: choose one "
                        f"with --array, or compute it with --formula. Its arrays: {listing(reader)}.")
    say(f"Using {used}")
    return reader, None, used.rstrip(".")


def new_medium(reader, array, options):
    """The data with their refractivity, made when it is needed."""
    medium = pv.RefractiveIndex(Input=reader)
    configure(medium, array, options)
    return medium


def is_axisymmetric(options):
    return dict(options.settings).get("Symmetry") == "Axisymmetric"


def bounds_of(reader, medium, options):
    """Those of the data; of axisymmetric data, of the body of revolution; of a plane, with its depth."""
    bounds = list(reader.GetDataInformation().GetBounds())
    extent = np.array(bounds[1::2]) - bounds[0::2]
    flat = int(extent.argmin())
    is_flat = extent[flat] <= 1e-9 * extent.max()
    if is_flat and not options.view:
        options.view = VIEWS["xyz"[flat]] if flat != 1 else VIEWS["-y"]
    if is_axisymmetric(options):
        medium.UpdatePipeline()
        made = list(medium.GetDataInformation().GetBounds())
        return made if made[0] < made[1] else bounds
    if is_flat:
        depth = dict(options.settings).get("Depth", 0) or np.delete(extent, flat).min()
        bounds[2 * flat:2 * flat + 2] = bounds[2 * flat] - depth / 2, bounds[2 * flat] + depth / 2
    return bounds


def configure(proxy, array, options):
    """What RefractiveIndex and Schlieren have in common: what the index of refraction is."""
    proxy.IndexModel = options.model
    if array:
        setattr(proxy, MODELS[options.model], list(array))
    proxy.GladstoneDaleConstant = options.constant
    proxy.DensityScale = options.density_scale
    for name, value in options.settings:
        if name in proxy.ListProperties():
            put(proxy, name, value)


def put(proxy, name, value):
    """Sets a property; a mistake where it does not take the value."""
    try:
        setattr(proxy, name, value)
    except (TypeError, ValueError) as problem:
        words = getattr(proxy.GetProperty(name), "Available", None)
        takes = f"It takes {', '.join(map(str, words))}." if words else str(problem)
        raise DemoError(f"The property '{name}' does not take '{value}'. {takes}") from problem


def new_bench(reader, array, frame, options):
    schlieren = pv.Schlieren(Input=reader)
    configure(schlieren, array, options)
    schlieren.LengthScale = options.length_scale
    schlieren.ViewDirection = list(frame.direction)
    schlieren.ViewUp = list(frame.up)
    schlieren.FocalPoint = list(frame.center)
    schlieren.ParallelScale = frame.scale
    schlieren.ImageSize = [frame.width, frame.height]
    schlieren.Quality = "Publication"
    schlieren.SamplesPerPixel = 4
    for name, value in options.settings:
        if name not in schlieren.ListProperties():
            raise DemoError(f"The Schlieren filter has no property '{name}'. "
                            f"It has: {', '.join(schlieren.ListProperties())}.")
        put(schlieren, name, value)
    return schlieren


def output_of(proxy, what, messages, port=0):
    proxy.UpdatePipeline()
    image = servermanager.Fetch(proxy, idx=port)
    if image is None or image.GetNumberOfPoints() == 0:
        raise DemoError(f"The {what} failed. {messages.last_error()}")
    for warning in messages.warnings():
        say(warning)
    return image


def check_light(blocked, frame):
    """Says which fraction of the light is blocked; a mistake where all of it is."""
    fraction = blocked.sum() * frame.pixel ** 2 / frame.shadow
    if fraction > 0.99:
        raise DemoError("No light comes through: every line of sight meets a place that is solid or "
                        "that no cell covers. Choose another --view, or let light pass outside of "
                        "all cells: --set Outside=Passes")
    if fraction > 0.1:
        say(f"{fraction:.0%} of the light is blocked: by solids, or by places that no cell covers "
            "(--set Outside=Passes lets it pass there)")
