# SPDX-License-Identifier: MIT
# halflight from Python, by ctypes alone: a furnace, a closed room that shines everywhere, whose light is known: B = E / (1 - reflectance).
#
#     python3 bake_from_python.py path/to/libhalflight_c.so
import ctypes
import sys

hl = ctypes.CDLL(sys.argv[1])
hl.halflight_version.restype = hl.halflight_message.restype = hl.halflight_change.restype = ctypes.c_char_p
hl.halflight_create.restype = ctypes.c_void_p
floats, indices, doubles = ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_uint32), ctypes.POINTER(ctypes.c_double)
corner_colors, vertex_colors, lightmap_texels, lightmap_coordinates = range(4)  # halflight_result
job_type, size, text = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_char_p
hl.halflight_destroy.argtypes = hl.halflight_run.argtypes = hl.halflight_message.argtypes = [job_type]
hl.halflight_set_positions.argtypes = [job_type, floats, size, size]
hl.halflight_set_triangles.argtypes = [job_type, indices, size, indices]
hl.halflight_add_material.argtypes = [job_type, text, doubles, doubles]
hl.halflight_set_number.argtypes = [job_type, text, ctypes.c_double]
hl.halflight_read.argtypes = [job_type, ctypes.c_int, floats, size]
hl.halflight_at.argtypes = [job_type, size, floats, ctypes.c_int, floats]
hl.halflight_figure.argtypes = [job_type, text, doubles]
hl.halflight_change.argtypes = [job_type, size]
hl.halflight_make_lightmap.argtypes = [job_type, ctypes.c_double, ctypes.c_uint32, indices, indices]
progress_type = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_double)
hl.halflight_set_progress.argtypes = [job_type, progress_type, ctypes.c_void_p]


def check(job, status):
    if status != 0:
        sys.exit(f"{status}: {hl.halflight_message(job).decode()}")


# Eight corners, twelve triangles, seen from inside.
xyz = [float(c) for z in (0, 1) for y in (0, 1) for x in (0, 2) for c in (x, y, z)]
quads = [(0, 2, 6, 4), (1, 5, 7, 3), (0, 4, 5, 1), (2, 3, 7, 6), (0, 1, 3, 2), (4, 6, 7, 5)]
triangles = [v for a, b, c, d in quads for v in (a, b, c, a, c, d)]
positions, corners = (ctypes.c_float * len(xyz))(*xyz), (ctypes.c_uint32 * len(triangles))(*triangles)

job = hl.halflight_create()
print("version", hl.halflight_version().decode() != "")
hl.halflight_add_material(job, b"oven", (ctypes.c_double * 3)(0.2, 0.5, 0.8), (ctypes.c_double * 3)(1, 2, 3))
check(job, hl.halflight_set_positions(job, positions, len(xyz) // 3, 3))
check(job, hl.halflight_set_triangles(job, corners, len(triangles) // 3, None))
check(job, hl.halflight_set_number(job, b"epsilon", 0.05))
stages = []
watch = progress_type(lambda user, stage, fraction: stages.append(stage.decode()) or 0)
check(job, hl.halflight_set_progress(job, watch, None))
check(job, hl.halflight_run(job))

colors = (ctypes.c_float * len(xyz))()
check(job, hl.halflight_read(job, vertex_colors, colors, len(xyz) // 3))
print("expected     1.250 4.000 15.000")
at_corners = (ctypes.c_float * (3 * len(triangles)))()
check(job, hl.halflight_read(job, corner_colors, at_corners, len(triangles)))
print("corner 35   ", *(f"{c:.3f}" for c in at_corners[-3:]))
print("vertex 0    ", *(f"{c:.3f}" for c in colors[:3]))
print("vertex 7    ", *(f"{c:.3f}" for c in colors[-3:]))
inside = (ctypes.c_float * 3)()
check(job, hl.halflight_at(job, 8, (ctypes.c_float * 3)(0.7, 0.3, 0), 0, inside))
print("on the floor", *(f"{c:.3f}" for c in inside))

# The same as a texture: every texel within the room's walls has that light, and where a corner lies in it is told.
width, height = ctypes.c_uint32(), ctypes.c_uint32()
check(job, hl.halflight_make_lightmap(job, 0.02, 1024, ctypes.byref(width), ctypes.byref(height)))
texels, uv = (ctypes.c_float * (3 * width.value * height.value))(), (ctypes.c_float * (2 * len(triangles)))()
check(job, hl.halflight_read(job, lightmap_texels, texels, width.value * height.value))
check(job, hl.halflight_read(job, lightmap_coordinates, uv, len(triangles)))
used = [texels[i] for i in range(0, len(texels), 3) if texels[i] > 0]
print(f"lightmap     {width.value} x {height.value}, {len(used)} texels used, light {min(used):.3f} to {max(used):.3f}")
print("last corner ", *(f"{c:.3f}" for c in uv[-2:]))
faces = ctypes.c_double()
check(job, hl.halflight_figure(job, b"faces", faces))
print("faces solved", int(faces.value), "of", len(triangles) // 3, "triangles")
print("change      ", hl.halflight_change(job, 0).decode())
print("stages      ", "link" in stages)
print("refused     ", hl.halflight_set_number(job, b"epsilon", -1), hl.halflight_message(job).decode())
print("refused     ", hl.halflight_add_material(job, b"mirror", (ctypes.c_double * 3)(2, 0, 0), None), hl.halflight_message(job).decode())
print("too early   ", hl.halflight_read(hl.halflight_create(), lightmap_texels, texels, 1))
print("unknown     ", hl.halflight_read(job, 4, texels, 1), hl.halflight_message(job).decode())
print("too small   ", hl.halflight_read(job, lightmap_texels, texels, 3), hl.halflight_message(job).decode())
print("too small   ", hl.halflight_read(job, vertex_colors, colors, 3), hl.halflight_message(job).decode())

# Told to stop, a run ends soon with the best that it has.
stop = progress_type(lambda user, stage, fraction: 1)
check(job, hl.halflight_set_progress(job, stop, None))
check(job, hl.halflight_set_number(job, b"epsilon", 0.005))
check(job, hl.halflight_run(job))
interrupted, epsilon = ctypes.c_double(), ctypes.c_double()
check(job, hl.halflight_figure(job, b"interrupted", interrupted))
check(job, hl.halflight_figure(job, b"epsilon", epsilon))
check(job, hl.halflight_read(job, vertex_colors, colors, len(xyz) // 3))
print(f"stopped      {interrupted.value:.0f}, with epsilon {epsilon.value}: vertex 7", *(f"{c:.3f}" for c in colors[-3:]))
hl.halflight_destroy(job)
