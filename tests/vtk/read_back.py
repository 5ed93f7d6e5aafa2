"""Opens the particle frames of runs with VTK and compares them with their CSV files, bit by bit.

    python read_back.py RUN_DIRECTORY...

For each run: `particles.pvd` must list exactly the frames that are in `frames/`, each once, at
rising times; for each frame, every array that VTK reads from the .vtp must hold the numbers that
are in the .csv. The first numbers that differ are named. Exit status: 0 all equal, 1 otherwise.
"""

import csv
import math
import struct
import sys
from array import array
from pathlib import Path

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow, vtkVersion
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkIOXMLParser import vtkXMLUtilities

HEADERS = {
    "id,kind,x_m,y_m,vx_m_per_s,vy_m_per_s,density_kg_per_m3,pressure_Pa": 2,
    "id,kind,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,density_kg_per_m3,pressure_Pa": 3,
}
KINDS = {"fluid": 0, "wall": 1}


class Different(Exception):
    """What VTK read is not what it should have read."""


def expect(found, expected, what):
    """Requires equality."""
    if found != expected:
        raise Different(f"{what} is {found!r} instead of {expected!r}")


def bits(value):
    """Bits of a float, in hexadecimal: tells 0.0 from -0.0, and one NaN from another."""
    return struct.pack(">d", value).hex() if isinstance(value, float) else value


def read_csv(path):
    """Arrays by their VTK names, each a flat `array` of numbers."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    axes = HEADERS.get(",".join(rows[0]))
    if axes is None:
        raise Different(f"the header of {path.name} is {','.join(rows[0])!r}")
    arrays = {name: array("d") for name in ("position", "velocity", "density", "pressure")}
    arrays["id"], arrays["kind"] = array("q"), array("B")
    flat = [0.0] * (3 - axes)  # z of a plane
    for identity, kind, *numbers in rows[1:]:
        values = [float(number) for number in numbers]  # rounds correctly
        expect(len(values), 2 * axes + 2, f"the number of columns of particle {identity}")
        arrays["id"].append(int(identity))
        arrays["kind"].append(KINDS[kind])
        arrays["position"].extend(values[:axes] + flat)
        arrays["velocity"].extend(values[axes : 2 * axes] + flat)
        arrays["density"].append(values[-2])
        arrays["pressure"].append(values[-1])
    return arrays


def compare(found, expected, components, what):
    """Requires that a vtkDataArray has the type, shape and bits of `expected`."""
    if found is None:
        raise Different(f"{what} is missing")
    type_name = {"d": "double", "B": "unsigned char", "q": "signed 64-bit"}[expected.typecode]
    found_type = found.GetDataTypeAsString()
    if expected.typecode == "q" and found_type in ("long", "long long", "vtkIdType", "vtktypeint64"):
        found_type = type_name  # whatever this platform calls it
    expect(found_type, type_name, f"the type of {what}")
    expect(found.GetNumberOfComponents(), components, f"the number of components of {what}")
    expect(found.GetNumberOfValues(), len(expected), f"the number of values of {what}")
    read = array(expected.typecode)
    if len(expected):
        read.frombytes(memoryview(found).tobytes())
    if read.tobytes() == expected.tobytes():
        return
    for index, (a, b) in enumerate(zip(read, expected)):
        if bits(a) != bits(b):
            raise Different(f"{what}[{index}] is {a!r} ({bits(a)}) instead of {b!r} ({bits(b)})")


def field(data, name):
    """The only value of a field array."""
    values = data.GetFieldData().GetArray(name)
    if values is None or values.GetNumberOfValues() != 1:
        raise Different(f"{name} is not one value")
    return values.GetValue(0)


def compare_frame(vtp, elapsed):
    """Compares a .vtp with the .csv beside it; returns what to say about it."""
    expected = read_csv(vtp.with_suffix(".csv"))
    reader = vtkXMLPolyDataReader()
    if not reader.CanReadFile(str(vtp)):
        raise Different("VTK cannot read it")
    reader.SetFileName(str(vtp))
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    expect(times, (elapsed,), "the time in the pipeline")
    reader.Update()
    expect(reader.GetErrorCode(), 0, "the reader's error code")
    data = reader.GetOutput()

    count = len(expected["id"])
    expect(data.GetNumberOfPoints(), count, "the number of points")
    points = data.GetPointData()
    expect(points.GetNumberOfArrays(), 5, "the number of point arrays")
    for name, components in [("id", 1), ("kind", 1), ("velocity", 3), ("density", 1), ("pressure", 1)]:
        compare(points.GetArray(name), expected[name], components, name)
    if count:  # of no points, VTK chooses the type itself
        compare(data.GetPoints().GetData(), expected["position"], 3, "position")
    expect(len(set(expected["id"])), count, "the number of different ids")

    for cells in ("NumberOfVerts", "NumberOfCells"):
        expect(getattr(data, f"Get{cells}")(), count, cells)
    for cell in range(count):
        ends = [data.GetCell(cell).GetPointId(0), data.GetCell(cell).GetNumberOfPoints()]
        expect(ends, [cell, 1], f"point and size of cell {cell}")

    expect(bits(field(data, "TimeValue")), bits(elapsed), "TimeValue")
    way_back, step, time = (field(data, name) for name in ("way_back", "step", "time"))
    mass = field(data, "particle_mass")
    if way_back not in (0, 1) or step < 0 or not math.isfinite(time) or not mass > 0:
        raise Different(f"way_back, step, time or mass make no sense: {way_back, step, time, mass}")
    walls = sum(expected["kind"])
    way = "back" if way_back else "out"
    return f"{count - walls} fluid, {walls} wall, step {step}, {time} s on the way {way}"


def collection(path):
    """Times and files of a .pvd, by VTK's own XML parser."""
    root = vtkXMLUtilities.ReadElementFromFile(str(path))
    if root is None:
        raise Different("VTK's parser cannot read it")
    expect((root.GetName(), root.GetAttribute("type")), ("VTKFile", "Collection"), "the root")
    list_ = root.FindNestedElementWithName("Collection")
    sets = [list_.GetNestedElement(i) for i in range(list_.GetNumberOfNestedElements())]
    expect({s.GetName() for s in sets} - {"DataSet"}, set(), "the other elements")
    frames = [(float(s.GetAttribute("timestep")), s.GetAttribute("file")) for s in sets]
    times = [time for time, _ in frames]
    expect(times, sorted(set(times)), "the list of times")
    files = [file for _, file in frames]
    for suffix in (".vtp", ".csv"):
        present = sorted(f"frames/{p.name}" for p in (path.parent / "frames").glob(f"*{suffix}"))
        listed = sorted(str(Path(file).with_suffix(suffix).as_posix()) for file in files)
        expect(listed, present, f"the list of {suffix} files")
    if not frames:
        raise Different("it has no frames")
    return frames


def check(name, function, *arguments):
    """Prints how a check went; returns its result, None if it failed."""
    messages = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(messages)  # VTK reports errors as text, and goes on
    try:
        result = function(*arguments)
        expect(messages.GetOutput(), "", "what VTK complains of")
    except (Different, OSError, KeyError, ValueError, IndexError) as error:
        print(f"FAILED vtk {name}: {error}")
        return None
    shown = result if isinstance(result, str) else f"{len(result)} frames"
    print(f"PASSED vtk {name}: {shown}")
    return result


def main(directories):
    if not directories:
        sys.exit(__doc__)
    print(f"VTK {vtkVersion.GetVTKVersion()}")
    passed = True
    for directory in map(Path, directories):
        frames = check("particles.pvd", collection, directory / "particles.pvd")
        passed &= frames is not None
        for elapsed, file in frames or []:
            passed &= check(file, compare_frame, directory / file, elapsed) is not None
    sys.exit(0 if passed else 1)


if __name__ == "__main__":
    main(sys.argv[1:])
