/* SPDX-License-Identifier: MIT
 *
 * halflight from C: a furnace, a closed room that shines everywhere, whose light is known: B = E / (1 - reflectance). With an installed
 * package:
 *
 *     find_package(halflight 0.1 REQUIRED)                    cc bake_from_c.c $(pkg-config --cflags --libs halflight_c)
 *     target_link_libraries(bake PRIVATE halflight::c)
 */
#include <stdio.h>

#include <halflight.h>

static const float corners[] = {0, 0, 0, 2, 0, 0, 0, 1, 0, 2, 1, 0, 0, 0, 1, 2, 0, 1, 0, 1, 1, 2, 1, 1};
/* Twelve triangles, seen from inside. */
static const uint32_t triangles[] = {0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3, 0, 4, 5, 0, 5, 1,
                                     2, 3, 7, 2, 7, 6, 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5};

int main(void) {
  const double reflectance[] = {0.2, 0.5, 0.8}, emission[] = {1, 2, 3};
  float light[24];
  int failed = 0;
  halflight_job* job = halflight_create();
  halflight_add_material(job, "oven", reflectance, emission);
  halflight_set_positions(job, corners, 8, 3);
  halflight_set_triangles(job, triangles, 12, NULL);
  halflight_set_number(job, "epsilon", 0.05);
  if (halflight_run(job) == HALFLIGHT_OK && halflight_read(job, HALFLIGHT_VERTEX_COLORS, light, 8) == HALFLIGHT_OK) {
    printf("expected  1.250 4.000 15.000\n");
    printf("vertex 7  %.3f %.3f %.3f\n", light[21], light[22], light[23]);
  } else {
    printf("%s\n", halflight_message(job));
    failed = 1;
  }
  halflight_destroy(job);
  return failed;
}
