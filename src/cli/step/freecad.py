# Converts STEP to GLB with FreeCAD: freecadcmd SCRIPT.py, with the arguments in variables of the environment, because FreeCAD opens
# further words as documents.
import os
import sys

try:
    import FreeCAD
    import Import

    source, target = os.environ["LIGNE_STEP_IN"], os.environ["LIGNE_STEP_OUT"]
    tolerance, angle = float(os.environ["LIGNE_STEP_TOLERANCE"]), float(os.environ["LIGNE_STEP_ANGLE"])
    document = FreeCAD.newDocument("step")
    Import.insert(source, document.Name)
    roots = [thing for thing in document.Objects if not thing.InList]
    for thing in document.Objects:
        if hasattr(thing, "Shape") and not thing.Shape.isNull():
            # The exporter takes the triangles that a shape has.
            thing.Shape.tessellate(tolerance)
    Import.export(roots, target)
    status = 0 if os.path.exists(target) else 1
except Exception as error:
    print(error)
    status = 1
sys.stdout.flush()
# FreeCAD would go on with a prompt.
os._exit(status)
