/* SPDX-License-Identifier: MIT
 *
 * The C interface, for other languages: triangles go in, the radiosity at their corners and vertices comes out. It wraps bake.hpp, as the
 * shared library halflight_c; units and meanings are those of bake.hpp.
 *
 *     halflight_job* job = halflight_create();
 *     int grey = halflight_add_material(job, "grey", (double[3]){0.5, 0.5, 0.5}, NULL);
 *     halflight_set_positions(job, xyz, vertices, 3);
 *     halflight_set_triangles(job, indices, triangles, material_of_each);
 *     if (halflight_run(job) != HALFLIGHT_OK) puts(halflight_message(job));
 *     halflight_read(job, HALFLIGHT_VERTEX_COLORS, rgb, vertices);
 *     halflight_destroy(job);
 *
 * Positions are in metres; emission and radiosity are exitances in W/m2; reflectances lie in [0, 1]; colours are linear. The radiance of a
 * surface is B / pi. Corners run counter-clockwise seen from the front. Nothing is printed; no function ends the program. A job may be used
 * by one thread at a time; several jobs may run in parallel. Strings are UTF-8, belong to the job and live until its next call. Functions
 * refuse a null job. */
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
  HALFLIGHT_CANCELLED = 2,     /* before there was a solution; afterwards HALFLIGHT_OK, and the figure interrupted is 1 */
  HALFLIGHT_OUT_OF_MEMORY = 3, /* no solution fits; if a coarser one does, HALFLIGHT_OK, and the figure coarsened is 1 */
  HALFLIGHT_NOT_RUN = 4,       /* there is no result to read yet */
  HALFLIGHT_NOTHING = 5        /* there is no light, option, figure or change with this name or number */
} halflight_status;

/* "0.1.0" */
HALFLIGHT_API const char* halflight_version(void);

/* A job with default options; null when there is no memory. */
HALFLIGHT_API halflight_job* halflight_create(void);
HALFLIGHT_API void halflight_destroy(halflight_job* job);

/* `count` vertices x y z, each `stride` floats after the one before. The buffer is not copied: it must stay unchanged until halflight_run
 * returns and, if halflight_make_lightmap is used, until that returns. Setting a buffer again discards the results. */
HALFLIGHT_API halflight_status halflight_set_positions(halflight_job* job, const float* xyz, size_t count, size_t stride);
/* Three indices per triangle and one material per triangle; null: all have material 0. The buffers are not copied, see above. */
HALFLIGHT_API halflight_status halflight_set_triangles(halflight_job* job, const uint32_t* indices, size_t triangles,
                                                       const uint32_t* material);
/* Returns the number of the material, from 0 on, or -(halflight_status). If `emission` is null the material does not emit. */
HALFLIGHT_API int halflight_add_material(halflight_job* job, const char* name, const double reflectance[3], const double emission[3]);

/* Sets an option by name. The last column has the defaults:
 *     epsilon, min_area   largest form factor of a link, smallest patch (share of the lit area)  0.005, 6e-5
 *     error               refine until the measured relative error is at most this; 0: off       0
 *     seconds             refine for this long, the most promising links first; 0: off           0
 *     audit_points        points at which the error is measured; 0: it is not measured           2000
 *     threads, seed       0 threads: all cores; results do not depend on the number              0, 1
 *     memory              limit in bytes; if too small, the solution is coarser; 0: no limit     0
 *     weld                vertices closer than this are merged; share of the scene's diagonal    1e-6
 *     two_sided, merge    1 or 0: surfaces reflect on both sides; coplanar triangles are merged  0, 1 */
HALFLIGHT_API halflight_status halflight_set_number(halflight_job* job, const char* option, double value);

/* Called now and then while a job runs, from the thread that called halflight_run. A result other than 0 cancels the run, which soon ends
 * with the best solution so far (see HALFLIGHT_CANCELLED). The callback must not use the job: calls that would change it are refused or do
 * nothing. */
typedef int (*halflight_progress)(void* user, const char* stage, double fraction);
HALFLIGHT_API halflight_status halflight_set_progress(halflight_job* job, halflight_progress callback, void* user);

HALFLIGHT_API halflight_status halflight_run(halflight_job* job);
/* What was wrong in the last call that did not return HALFLIGHT_OK, one sentence a line. halflight_at sets no message. */
HALFLIGHT_API const char* halflight_message(const halflight_job* job);

/* Results that can be read after a run, with the number of floats per element:
 *     corner colours        3: radiosity of each corner, in the order of the indices
 *     vertex colours        3: radiosity of each vertex, in the order of the positions
 *     lightmap texels       3: radiosity of each of width * height texels, row by row, beginning with v = 0
 *     lightmap coordinates  2: u v in [0, 1] of each corner, in the order of the indices; 0 0 for triangles without light */
typedef enum halflight_result {
  HALFLIGHT_CORNER_COLORS = 0,
  HALFLIGHT_VERTEX_COLORS = 1,
  HALFLIGHT_LIGHTMAP_TEXELS = 2,
  HALFLIGHT_LIGHTMAP_COORDINATES = 3
} halflight_result;

/* Copies a result (a halflight_result) to `out`, which has room for `count` corners, vertices or texels. HALFLIGHT_INVALID if there are
 * more of them, HALFLIGHT_NOTHING if there is no result of this number, HALFLIGHT_NOT_RUN before halflight_run or, for a lightmap, before
 * halflight_make_lightmap. */
HALFLIGHT_API halflight_status halflight_read(halflight_job* job, int result, float* out, size_t count);
/* The radiosity at a point of a triangle, on its front or its back. HALFLIGHT_NOTHING if the triangle has no light, HALFLIGHT_INVALID if
 * the point is not finite. May be called from many threads at once. */
HALFLIGHT_API halflight_status halflight_at(const halflight_job* job, size_t triangle, const float point[3], int back, float rgb[3]);

/* Makes a lightmap for halflight_read and returns its size: an atlas with a rectangle for every planar face. Texels are squares with sides
 * of `texel` metres, doubled until no side of the atlas has more than `most` texels (at least 64). texel = 0: about a million texels. The
 * buffers that were set are read again and must still exist. */
HALFLIGHT_API halflight_status halflight_make_lightmap(halflight_job* job, double texel, uint32_t most, uint32_t* width, uint32_t* height);

/* Returns a figure of the run by name: error, error_low, error_high (relative L2 and its 95 % interval; error_low is 0 if noise hides the
 * error, and error its upper bound), seconds, cpu_seconds, faces, leaves, links, rays, residual, iterations, converged, interrupted,
 * coarsened (1: stopped or short of memory, with a larger epsilon than requested), epsilon, without (number of corners without light of
 * their own). */
HALFLIGHT_API halflight_status halflight_figure(halflight_job* job, const char* name, double* value);
/* Sentence `number` of: repairs of the triangles, warnings, the reason if the run ended early, and what is known of an error that was not
 * reached. Null beyond the last one. */
HALFLIGHT_API const char* halflight_change(const halflight_job* job, size_t number);

#ifdef __cplusplus
}
#endif
#endif
