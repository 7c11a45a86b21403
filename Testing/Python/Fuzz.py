# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Random data and random values of all properties: no crash, no hang, no exception that leaves VTK, and either an image of
finite numbers or an error and an empty output; a filter that has been given anything makes, with good data and the
defaults, what a new one makes.

    pvpython Fuzz.py                      # the first cases of all kinds, some half a minute of processor time
    pvpython Fuzz.py KIND FIRST [COUNT]   # these cases of a kind, with their output

Kinds: filters (objects of VTK), proxies (of ParaView), views (the representation), ranks (two of MPI). A case is a number,
the seed of all that is random in it, and runs in a process of its own. SCHLIEREN_FUZZ_SECONDS: as many cases as take that
long instead; SCHLIEREN_FUZZ_FIRST: another first case than 0.
"""

import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback

from ranks_testing import MPIEXEC

KINDS = {"filters": (20, .5), "proxies": (6, .25), "views": (3, .2), "ranks": (1, .05)}  # cases, and shares of a time that is given
SECONDS_OF_CASE = 120  # of the processor; the longest take some 10
BYTES_OF_CASE = 8 << 30  # of addresses
EXTREMES = (float("nan"), float("inf"), -float("inf"), 0., -1., 1e-300, 1e300, 2., .5, 1e-6, 1e6, 90.)
INTEGERS = (0, 1, 2, 3, 7, -1, 64, 1000, 2**31 - 1, -2**31)
TEXTS = ("", "None", "rho", "p", "air", "N2", "1e-3", "2e-4 .03", "data:image/png;base64,AAAA", "/no/such.png", "é%s%n", "x" * 10000)

# Of properties with which an image may take as long as one likes: values with which it takes a moment.
QUICK = {"ImageSize": ([16, 16], [16, 16], [33, 7], [1, 1], [0, 16], [16, -3], [2**31 - 1, 2**31 - 1]),
         "SamplesPerPixel": (1, 1, 2, 5, 0, -1), "MediumMemory": (1, 2, 8),
         "NumberOfThreads": (0, 1, 2, 3, -1),
         "SmoothingRadius": (0., 1., 2.5, -1., float("nan"), float("inf")),
         "StepSize": (2., 1., .1, 16., 17., 0., -1., float("nan")),
         "MediumTolerance": (.02, .1, .5, 1., 0., -1., float("nan")),
         "TimeLimit": (0., 0., 1e-3, -1.)}


def random_value(rng, item):
    """For a property of Utilities/property_tables.py."""
    if item.name in QUICK:
        return rng.choice(QUICK[item.name])
    tag = item.element.tag
    if item.entries and rng.random() < .9:
        return rng.choice(list(item.entries.values()))
    one = (lambda: rng.choice(TEXTS)) if tag.startswith("String") else (lambda: rng.choice(INTEGERS)) \
        if tag.startswith("Int") else (lambda: rng.choice((*EXTREMES, rng.uniform(-2, 2), rng.uniform(0, 1e-3))))
    if item.element.find("BooleanDomain") is not None:
        return rng.randrange(2)
    if item.element.get("repeat_command") == "1":
        return [one() for _ in range(rng.choice((0, 1, 2, 3, 3, 6)))]
    count = int(item.element.get("number_of_elements") or 1)
    return one() if count == 1 else [one() for _ in range(count)]


def random_function(rng):
    from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
    made = vtkPiecewiseFunction()
    for _ in range(rng.choice((0, 1, 2, 4))):
        made.AddPoint(rng.choice((0., 1., rng.random(), 1e300)), rng.choice((0., 1., rng.random(), -1.)))
    return made


def settable(files=None):
    from property_tables import read
    return [item for item in read(files).values() if item.group not in ("Inputs", "Commands", "Information")]


def check_image(image, has_failed, what):
    """Nothing after an error; else numbers."""
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    if not image.IsA("vtkImageData"):  # of Refractive Index, whose output is of the kind of its input
        assert not has_failed or image.GetNumberOfElements(image.POINT) == 0, f"{what}: an output after an error"
        return
    count = image.GetNumberOfPoints()
    attributes = image.GetPointData()
    if has_failed:
        assert count == 0 or attributes.GetNumberOfArrays() == 0, f"{what}: an output after an error"
        return
    for n in range(attributes.GetNumberOfArrays()):
        array = attributes.GetArray(n)
        assert array.GetNumberOfTuples() == count, f"{what}: {array.GetName()} has not all values"
        if count and array.GetName() in ("Intensity", "BlockedFraction", "Deflection", "OpticalPathDifference"):
            assert np.isfinite(vtk_to_numpy(array)).all(), f"{what}: {array.GetName()} has values that are no numbers"


class Errors:
    """Counts those of an object of VTK."""

    def __init__(self, algorithm):
        self.texts = []
        self.call = lambda _object, _event: self.texts.append("error")
        algorithm.AddObserver("ErrorEvent", self.call)

    def taken(self):
        texts, self.texts[:] = list(self.texts), []
        return texts


class OfFilter:
    """Sets properties of an object of VTK as ParaView would."""

    def __init__(self, algorithm):
        self.algorithm = algorithm

    def set(self, rng, item, value):
        algorithm, command = self.algorithm, item.command
        if item.is_array:
            index = int(item.element.get("default_values", "0").split(item.element.get("default_values_delimiter", " "))[0])
            algorithm.SetInputArrayToProcess(index, 0, 0, rng.choice((0, 1)), value)
        elif item.element.tag == "ProxyProperty":
            if item.element.get("clean_command"):
                getattr(algorithm, item.element.get("clean_command"))()
                for function in value:
                    getattr(algorithm, command)(function)
            else:
                getattr(algorithm, command)(value[0] if value else None)
        elif item.element.get("repeat_command") == "1":
            getattr(algorithm, item.element.get("clean_command"))()
            if command == "SetFocalPoint":
                if len(value) == 3:
                    algorithm.SetFocalPoint(*value)
                return
            for one in value:
                getattr(algorithm, command)(one)
        else:
            getattr(algorithm, command or "Set" + item.name)(value)

    def change(self, rng, item):
        if item.is_array:
            value = rng.choice(("rho", "p", "T", "None", "", "x y/z"))
        elif item.element.tag == "ProxyProperty":
            value = [random_function(rng) for _ in range(rng.randrange(3))]
        else:
            value = random_value(rng, item)
        self.set(rng, item, value)

    def reset(self, rng, item):
        if item.is_array:
            self.set(random.Random(1), item, "rho" if item.name == "Density" else "None")
            return
        if item.element.tag == "ProxyProperty":
            self.set(rng, item, [])
            return
        value = item.default
        if item.entries and isinstance(value, str):
            value = item.entries[value]
        self.set(rng, item, value)


def good_again(image, expected, what):
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    for name in ("Intensity", "Refractivity"):
        array, other = image.GetPointData().GetArray(name), expected.GetPointData().GetArray(name)
        assert (array is None) == (other is None), f"{what}: no image with good values"
        if array:
            assert array.GetNumberOfTuples() == other.GetNumberOfTuples(), what
            difference = np.nan_to_num(np.abs(vtk_to_numpy(array) - vtk_to_numpy(other))).max(initial=0)
            assert difference <= 1e-6, f"{what}: not the image of a new filter, {name} differs by {difference}"


def case_of_filters(rng, rank=None):
    import fuzz_data
    import property_tables
    from schlieren.vtkSchlierenFilters import vtkRefractiveIndex, vtkSchlierenFilter
    from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
    is_grid = rng.random() < .2
    items = settable(property_tables.FILES[:1] if is_grid else None)
    by_name = {item.name: item for item in items}
    algorithm = (vtkRefractiveIndex if is_grid else vtkSchlierenFilter)()
    errors, properties = Errors(algorithm), OfFilter(algorithm)

    def give(port, data):
        producer = vtkTrivialProducer()
        producer.SetOutput(data)
        algorithm.SetInputConnection(port, producer.GetOutputPort())

    def own_data():
        data = fuzz_data.any_data(rng, has_names=rng.random() < .95)
        is_empty = rng.random() < .5  # the same on all ranks, as all that is random
        return data.NewInstance() if rank and is_empty else data

    def set_up(other):
        for item in items:
            if not (is_grid and item.name == "Quality"):
                other.reset(rng, item)
        if not is_grid:
            other.algorithm.SetImageSize(16, 16)
            # Neither is that of an earlier image, as kept ones and settings for a target error may be.
            other.algorithm.SetKMode(other.algorithm.K_AUTOMATIC)
            other.algorithm.SetTargetError(0)
            other.algorithm.SetMediumMemory(4)
    set_up(properties)
    give(0, own_data())
    for step in range(rng.choice((1, 2, 4))):
        for item in rng.sample(items, rng.choice((0, 1, 2, 3, 8))):
            properties.change(rng, item)
        if rng.random() < .7:
            properties.set(rng, by_name["Density"], "rho")
        if rng.random() < .3:
            give(0, own_data())
        if not is_grid and rng.random() < .1:
            give(1, fuzz_data.surface(rng) if rng.random() < .8 else own_data())
        errors.taken()
        algorithm.Update()
        has_failed = bool(errors.taken())
        for port in range(algorithm.GetNumberOfOutputPorts()):
            check_image(algorithm.GetOutputDataObject(port), has_failed, f"step {step}")
        if not is_grid and rng.random() < .2:
            rng.choice((algorithm.Refine, algorithm.Stop, algorithm.Update))()
            algorithm.Update()
        str(algorithm)  # PrintSelf
    if not is_grid:
        algorithm.SetInputConnection(1, None)
    set_up(properties)
    give(0, fuzz_data.good_image())
    algorithm.Update()
    errors.taken()
    expected = type(algorithm)()
    again = OfFilter(expected)
    set_up(again)
    producer = vtkTrivialProducer()
    producer.SetOutput(fuzz_data.good_image())
    expected.SetInputConnection(0, producer.GetOutputPort())
    expected.Update()
    good_again(algorithm.GetOutputDataObject(0), expected.GetOutputDataObject(0), "afterwards")
    if not rank:
        assert algorithm.GetOutputDataObject(0).GetNumberOfPoints() > 0, "afterwards: nothing"


def producer_of(data):
    from paraview.simple import TrivialProducer
    made = TrivialProducer()
    made.GetClientSideObject().SetOutput(data)
    made.UpdatePipeline()
    return made


def change_proxy(rng, proxy, item):
    if item.is_array:
        proxy.GetProperty(item.name).SetData([rng.choice(("POINTS", "CELLS")), rng.choice(("rho", "p", "T", "None", ""))])
    elif item.element.tag != "ProxyProperty":
        value = random_value(rng, item)
        smproperty = proxy.SMProxy.GetProperty(item.name)
        values = value if isinstance(value, list) else [value]
        if rng.random() < .03:
            values = values[:-1] if rng.random() < .5 else values + values
        if smproperty.GetRepeatable():
            smproperty.SetNumberOfElements(len(values))
        for n, one in enumerate(values[:smproperty.GetNumberOfElements()]):
            smproperty.SetElement(n, one)
    proxy.SMProxy.UpdateVTKObjects()


def reset_proxy(proxy, new, items):
    for item in items:
        own, other = (of.SMProxy.GetProperty(item.name) for of in (proxy, new))
        own.Copy(other)
        if item.element.tag != "ProxyProperty" and own.GetRepeatable() and other.GetNumberOfElements() == 0:  # not copied
            own.SetNumberOfElements(0)
    proxy.SMProxy.UpdateVTKObjects()


def case_of_proxies(rng):
    import fuzz_data
    import property_tables
    from paraview import simple
    is_grid = rng.random() < .2
    items = settable(property_tables.FILES[:1] if is_grid else None)
    make = getattr(simple, "RefractiveIndex" if is_grid else "Schlieren")
    proxy = make(Input=producer_of(fuzz_data.any_data(rng)))
    if not is_grid:
        proxy.ImageSize = [16, 16]
        proxy.MediumMemory = 4
    algorithm = proxy.GetClientSideObject()
    errors = Errors(algorithm)
    for step in range(rng.choice((1, 2, 4))):
        for item in rng.sample(items, rng.choice((0, 1, 2, 3, 8))):
            change_proxy(rng, proxy, item)
        if rng.random() < .3:
            proxy.Input = producer_of(fuzz_data.any_data(rng))
        errors.taken()
        proxy.UpdatePipeline()
        proxy.UpdatePropertyInformation()
        has_failed = bool(errors.taken())
        for port in range(algorithm.GetNumberOfOutputPorts()):
            check_image(algorithm.GetOutputDataObject(port), has_failed, f"step {step}")
    good = producer_of(fuzz_data.good_image())
    proxy.Input = good
    new = make(Input=good, Density=["POINTS", "rho"])
    if not is_grid:
        new.ImageSize = [16, 16]
        new.MediumMemory = 4
    reset_proxy(proxy, new, items)
    for other in (proxy, new):
        other.UpdatePipeline()
    differing = [item.name for item in items if item.element.tag != "ProxyProperty"
                 and str(proxy.GetPropertyValue(item.name)) != str(new.GetPropertyValue(item.name))]
    good_again(algorithm.GetOutputDataObject(0), new.GetClientSideObject().GetOutputDataObject(0), f"afterwards ({differing})")


def case_of_views(rng):
    import fuzz_data
    from paraview import simple
    of_view = {"ViewDirection", "ViewUp", "FocalPoint", "ParallelScale", "ViewAngle", "ImageSize", "TimeLimit"}
    items = [item for item in settable() if item.name not in of_view]
    view = simple.CreateRenderView()
    view.ViewSize = [48, 32]
    kinds = fuzz_data.LEAVES if rng.random() < .7 else (fuzz_data.blocks, fuzz_data.levels)
    data = rng.choice(kinds)(rng)
    if data.IsA("vtkDataSet"):
        fuzz_data.add_arrays(rng, data)
    display = simple.Show(producer_of(data), view)
    try:
        display.SetRepresentationType("Schlieren")
    except RuntimeError:  # not offered for such data
        return
    bench = display.SchlierenBench
    bench.MediumMemory = 4
    for _ in range(rng.choice((1, 2, 4))):
        for item in rng.sample(items, rng.choice((0, 1, 2, 4))):
            change_proxy(rng, bench, item)
        if rng.random() < .5:
            display.SchlierenTimeSlice = rng.choice((0, .01))
        camera = view.GetActiveCamera()
        if rng.random() < .5:
            simple.ResetCamera(view)
        if rng.random() < .3:
            camera.SetParallelProjection(rng.randrange(2))
            camera.SetViewAngle(rng.choice((30, 1e-3, 170)))
            camera.SetPosition(*(rng.choice((0, 1, -5, 1e9)) for _ in range(3)))
        display.Visibility = int(rng.random() < .9)
        (view.SMProxy.StillRender if rng.random() < .7 else view.SMProxy.InteractiveRender)()
        if rng.random() < .3:
            view.GetClientSideObject().StreamingUpdate([0.] * 24)
    simple.Delete(display)
    simple.Delete(view)


def case_of_ranks(rng):
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
    case_of_filters(rng, rank)


CASES = {"filters": case_of_filters, "proxies": case_of_proxies, "views": case_of_views, "ranks": case_of_ranks}


def prepare(kind):
    """What all cases of a kind have in common, before each gets a process."""
    sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Utilities"))
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import quick_sessions  # noqa: F401
    from paraview import simple
    simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=False, ns=vars(simple))


def run_case(kind, number):
    """In a process of its own, which it ends."""
    code = 0
    try:
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if "asan" not in os.environ.get("LD_PRELOAD", ""):
            resource.setrlimit(resource.RLIMIT_AS, (BYTES_OF_CASE, BYTES_OF_CASE))
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS_OF_CASE, SECONDS_OF_CASE + 5))
        CASES[kind](random.Random(f"{kind} {number}"))
    except BaseException:  # also what is not foreseen
        traceback.print_exc()
        code = 1
    sys.stdout.flush()
    sys.stderr.flush()
    if code or kind != "ranks":  # MPI has to be left in its own way
        os._exit(code)


def wait_for(pid):
    """The exit code of a process; of one that waits for ever, that of a timeout."""
    end = time.monotonic() + 10 * SECONDS_OF_CASE  # the machine may be busy
    while time.monotonic() < end:
        done, status = os.waitpid(pid, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(.005)
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    return 124


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def in_own_process(kind, number, output):
    pid = os.fork()
    if pid == 0:
        os.dup2(output.fileno(), 1)
        os.dup2(output.fileno(), 2)
        run_case(kind, number)
    return wait_for(pid)


def on_two_ranks(kind, number, output):
    command = [*MPIEXEC, "2", "pvbatch", "--force-offscreen-rendering",
               "--sym", os.path.abspath(__file__), "case", kind, str(number)]
    inherited = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_", "PRTE_"))}
    try:
        return subprocess.run(command, env=inherited, stdout=output, stderr=output, timeout=10 * SECONDS_OF_CASE,
                              check=False).returncode
    except subprocess.TimeoutExpired:
        return 124


def run_kind(kind, first, count, seconds, shows):
    """Cases until time is over; the names of those that failed."""
    if kind == "ranks":
        if not shutil.which("mpiexec") or not shutil.which("pvbatch"):
            return []
        run = on_two_ranks
    else:
        prepare(kind)
        run = in_own_process
    failed, slowest = [], (0., first)
    begin, number = processor_seconds(), first
    while (count is None or number < first + count) and processor_seconds() - begin < seconds:
        with tempfile.TemporaryFile() as output:
            before = processor_seconds()
            code = run(kind, number, output)
            slowest = max(slowest, (processor_seconds() - before, number))
            output.seek(0)
            text = output.read().decode(errors="replace")
        if code:
            failed.append(f"{kind} {number}")
            why = f"signal {signal.Signals(-code).name}" if code < 0 else "a hang" if code == 124 else f"exit code {code}"
            print(f"{kind} {number}: {why}\n" + "\n".join(text.splitlines()[-60:]), flush=True)
        elif shows:
            print(text, flush=True)
        number += 1
    print(f"{kind}: {number - first} cases from {first}, {len(failed)} failed, {processor_seconds() - begin:.0f} s of the "
          f"processor, {slowest[0]:.1f} s of them for {slowest[1]}", flush=True)
    return failed


def main(arguments):
    if arguments[:1] == ["case"]:
        prepare(arguments[1])
        run_case(arguments[1], int(arguments[2]))
        return
    first = int(os.environ.get("SCHLIEREN_FUZZ_FIRST", "0"))
    seconds = os.environ.get("SCHLIEREN_FUZZ_SECONDS")
    if arguments and arguments[0] in KINDS:
        kind, shows = arguments[0], len(arguments) > 1
        if shows:
            count, limit = int(arguments[2]) if len(arguments) > 2 else 1, float("inf")
            first = int(arguments[1])
        elif seconds:
            count, limit = None, float(seconds)
        else:
            count, limit = KINDS[kind][0], float("inf")
        failed = run_kind(kind, first, count, limit, shows)
    else:  # each kind by a process of its own, which has no threads and no connection that its cases would share
        failed = []
        for kind, (_, share) in KINDS.items():
            environment = os.environ | ({"SCHLIEREN_FUZZ_SECONDS": str(share * float(seconds))} if seconds else {})
            done = subprocess.run([os.readlink("/proc/self/exe"), os.path.abspath(__file__), kind], env=environment, check=False)
            failed += [kind] if done.returncode else []
    sys.stdout.flush()
    os._exit(1 if failed else 0)


main(sys.argv[1:])
