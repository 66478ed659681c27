/* SPDX-License-Identifier: MIT
 *
 * halflight for other languages: triangles in, the light on their corners and vertices out. It is bake.hpp in C, as the shared library
 * halflight_c; units and meanings are those of bake.hpp.
 *
 *     halflight_job* job = halflight_create();
 *     int grey = halflight_add_material(job, "grey", (double[3]){0.5, 0.5, 0.5}, NULL);
 *     halflight_set_positions(job, xyz, vertices, 3);
 *     halflight_set_triangles(job, indices, triangles, material_of_each);
 *     if (halflight_run(job) != HALFLIGHT_OK) puts(halflight_message(job));
 *     halflight_read(job, HALFLIGHT_VERTEX_COLORS, rgb, vertices);
 *     halflight_destroy(job);
 *
 * Positions are metres, emission and radiosity exitances in W/m2, reflectances lie in [0, 1], colours are linear. Radiance is B / pi.
 * Corners run counter-clockwise seen from the front. Nothing is printed; no function ends the program. A job belongs to one thread at a
 * time; several jobs may run side by side. Strings are UTF-8, belong to the job and live until its next call. A null job is refused. */
#ifndef HALFLIGHT_H
#define HALFLIGHT_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define HALFLIGHT_API
#else
#define HALFLIGHT_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct halflight_job halflight_job;

typedef enum halflight_status {
  HALFLIGHT_OK = 0,
  HALFLIGHT_INVALID = 1,       /* an argument, an option, or the scene: halflight_message says what */
  HALFLIGHT_CANCELLED = 2,     /* before there was a solution; later HALFLIGHT_OK, and the figure interrupted is 1 */
  HALFLIGHT_OUT_OF_MEMORY = 3, /* for any solution; if a coarser one fits, HALFLIGHT_OK, and the figure coarsened is 1 */
  HALFLIGHT_NOT_RUN = 4,       /* there is no result to read yet */
  HALFLIGHT_NOTHING = 5        /* no light, option, figure or change of this name or number */
} halflight_status;

/* "0.1.0" */
HALFLIGHT_API const char* halflight_version(void);

/* A job with default options; null when there is no memory. */
HALFLIGHT_API halflight_job* halflight_create(void);
HALFLIGHT_API void halflight_destroy(halflight_job* job);

/* `count` vertices of x y z, `stride` floats from one to the next. The caller keeps the buffer, unchanged, until halflight_run returns, or
 * longer for halflight_make_lightmap. To set buffers again forgets the results. */
HALFLIGHT_API halflight_status halflight_set_positions(halflight_job* job, const float* xyz, size_t count, size_t stride);
/* Three indices a triangle, and of each triangle its material, or null: all have material 0. Kept by the caller, as above. */
HALFLIGHT_API halflight_status halflight_set_triangles(halflight_job* job, const uint32_t* indices, size_t triangles,
                                                       const uint32_t* material);
/* Returns the number of the material, from 0 on, or a negative one: -(halflight_status). `emission` may be null: it does not shine. */
HALFLIGHT_API int halflight_add_material(halflight_job* job, const char* name, const double reflectance[3], const double emission[3]);

/* Options by name; all have defaults:
 *     epsilon, min_area   largest form factor of a link, smallest patch (share of the lit area)  0.005, 6e-5
 *     error               refine until the measured relative error is at most this; 0: off       0
 *     seconds             refine, the most promising first, for this long; 0: off                0
 *     audit_points        points at which the error is measured; 0: it is not                    2000
 *     threads, seed       0 threads: all; results do not depend on the number                    0, 1
 *     memory              bytes that a run may take; coarser where that is too little; 0: off    0
 *     weld                vertices closer than this are one; share of the scene's diagonal       1e-6
 *     two_sided, merge    1 or 0: surfaces reflect on both sides; coplanar triangles are merged  0, 1 */
HALFLIGHT_API halflight_status halflight_set_number(halflight_job* job, const char* option, double value);

/* Called now and then while a job runs, from the thread that runs it; another value than 0 stops the run, which soon ends with
 * the best that it has: see HALFLIGHT_CANCELLED. It must not use its own job: what would change it is refused, or does nothing. */
typedef int (*halflight_progress)(void* user, const char* stage, double fraction);
HALFLIGHT_API halflight_status halflight_set_progress(halflight_job* job, halflight_progress callback, void* user);

HALFLIGHT_API halflight_status halflight_run(halflight_job* job);
/* What was wrong in the last call that did not return HALFLIGHT_OK; one sentence a line. halflight_at leaves none. */
HALFLIGHT_API const char* halflight_message(const halflight_job* job);

/* What can be read of a job that has run, and the numbers of one of them:
 *     corner colours        3: radiosity of each corner, in the order of the indices
 *     vertex colours        3: radiosity of each vertex, in the order of the positions
 *     lightmap texels       3: radiosity of each texel, width times height of them, rows from v = 0 on
 *     lightmap coordinates  2: u v in [0, 1] of each corner, in the order of the indices; 0 0 of triangles without light */
typedef enum halflight_result {
  HALFLIGHT_CORNER_COLORS = 0,
  HALFLIGHT_VERTEX_COLORS = 1,
  HALFLIGHT_LIGHTMAP_TEXELS = 2,
  HALFLIGHT_LIGHTMAP_COORDINATES = 3
} halflight_result;

/* Copies a result, a halflight_result, to `out`, which has room for `count` corners, vertices or texels. HALFLIGHT_INVALID when there are
 * more of them, HALFLIGHT_NOTHING where there is no result of this number, HALFLIGHT_NOT_RUN before halflight_run, or of a lightmap before
 * halflight_make_lightmap. */
HALFLIGHT_API halflight_status halflight_read(halflight_job* job, int result, float* out, size_t count);
/* The radiosity at a point of a triangle, on its front or its back; HALFLIGHT_NOTHING where it has none, HALFLIGHT_INVALID when
 * the point is not finite. From many threads at once. */
HALFLIGHT_API halflight_status halflight_at(const halflight_job* job, size_t triangle, const float point[3], int back, float rgb[3]);

/* Makes a lightmap, for halflight_read, and tells its size: an atlas with a rectangle for every planar face of the triangles, its texels
 * squares with sides of `texel` metres, or of as more as keeps its sides within `most` texels (64 or more). 0: about a million texels. It
 * is made of the buffers that were set, which must still be there. */
HALFLIGHT_API halflight_status halflight_make_lightmap(halflight_job* job, double texel, uint32_t most, uint32_t* width, uint32_t* height);

/* Figures of the run by name: error, error_low, error_high (relative L2 and its 95 % interval), seconds, cpu_seconds, faces, leaves, links,
 * rays, residual, iterations, converged, interrupted, coarsened (1: stopped or short of memory, with a larger epsilon than asked
 * for), epsilon, without (corners of triangles that were left out). */
HALFLIGHT_API halflight_status halflight_figure(halflight_job* job, const char* name, double* value);
/* What was repaired in the triangles, what the run warns of, and why it ended early if it did, as sentences; null beyond the last one. */
HALFLIGHT_API const char* halflight_change(const halflight_job* job, size_t number);

#ifdef __cplusplus
}
#endif
#endif
