# Converts STEP to GLB with FreeCAD: freecadcmd SCRIPT.py, with the arguments in variables of the environment, because FreeCAD opens
# further words as documents. Names and units survive. Colours do not: FreeCAD keeps them in its windows.
import json
import os
import struct
import sys


def triangles(shape, tolerance, angle):
    import MeshPart

    mesh = MeshPart.meshFromShape(Shape=shape, LinearDeflection=tolerance, AngularDeflection=angle, Relative=False)
    return mesh.Topology


def convert(source, target, tolerance, angle):
    import FreeCAD
    import Import

    document = FreeCAD.newDocument("step")
    Import.insert(source, document.Name)
    # Millimetres and z up become metres and y up.
    nodes = [{"matrix": [0.001, 0, 0, 0, 0, 0, -0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1], "children": []}]
    meshes, accessors, views, chunks = [], [], [], []

    def accessor(kind, component, values, size, **bounds):
        data = struct.pack("<%d%s" % (len(values), "f" if component == 5126 else "I"), *values)
        views.append({"buffer": 0, "byteOffset": sum(map(len, chunks)), "byteLength": len(data)})
        chunks.append(data)
        count = len(values) // size
        accessors.append(dict(bufferView=len(views) - 1, componentType=component, type=kind, count=count, **bounds))
        return len(accessors) - 1

    for thing in document.Objects:
        # An assembly has the shapes of its parts once more.
        if thing.isDerivedFrom("App::Part") or not hasattr(thing, "Shape") or thing.Shape.isNull():
            continue
        shape = thing.Shape.copy()
        if hasattr(thing, "getGlobalPlacement"):
            shape.Placement = thing.getGlobalPlacement()
        points, facets = triangles(shape, tolerance, angle)
        if not facets:
            continue
        low = [min(point[axis] for point in points) for axis in range(3)]
        high = [max(point[axis] for point in points) for axis in range(3)]
        position = accessor("VEC3", 5126, [c for point in points for c in point], 3, min=low, max=high)
        indices = accessor("SCALAR", 5125, [corner for facet in facets for corner in facet], 1)
        meshes.append({"name": thing.Label, "primitives": [{"attributes": {"POSITION": position}, "indices": indices}]})
        nodes[0]["children"].append(len(nodes))
        nodes.append({"name": thing.Label, "mesh": len(meshes) - 1})
    if not meshes:
        raise ValueError("FreeCAD finds no shapes in this file")
    binary = b"".join(chunks)
    gltf = {
        "asset": {"version": "2.0", "generator": "ligne with FreeCAD"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": nodes,
        "meshes": meshes,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(binary)}],
    }
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    with open(target, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)


try:
    names = ["LIGNE_STEP_IN", "LIGNE_STEP_OUT", "LIGNE_STEP_TOLERANCE", "LIGNE_STEP_ANGLE"]
    source, target, tolerance, angle = [os.environ[name] for name in names]
    convert(source, target, float(tolerance), float(angle))
    status = 0
except Exception as error:
    print(error)
    status = 1
sys.stdout.flush()
# FreeCAD would go on with a prompt.
os._exit(status)
