# Converts STEP to GLB with cascadio: python -c SCRIPT IN.step OUT.glb TOLERANCE_MM ANGLE_RADIANS
# Exit status 91: cascadio is not installed.
import sys

# An empty entry is the working folder, where a file of the same name must not stand for the package.
sys.path[:] = [entry for entry in sys.path if entry]
try:
    import cascadio
except ImportError as error:
    print(error)
    sys.exit(91)
source, target, tolerance, angle = sys.argv[1:5]
failed = cascadio.step_to_glb(source, target, tol_linear=float(tolerance), tol_angular=float(angle))
if failed:
    print("cascadio cannot read this file")
sys.exit(1 if failed else 0)
