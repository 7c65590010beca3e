/* Who collides with whom? */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include <bch/bch.h>

static void check(bch_status status) {
  if (status == BCH_OK) return;
  fprintf(stderr, "%s: %s\n", bch_status_name(status), bch_last_error());
  exit(1);
}

int main(void) {
  /* A man in three poses. */
  bch_character* man = NULL;
  bch_pose poses[3];
  bch_shape_set_builder* builder = NULL;
  bch_shape_set* set = NULL;
  check(bch_character_default(BCH_MALE, &man));
  check(bch_character_sample_poses(man, 3, poses));
  check(bch_shape_set_builder_create(NULL, &builder));
  check(bch_shape_set_builder_add_poses(builder, man, poses, 3, NULL));
  check(bch_shape_set_builder_finish(builder, &set));

  /* Your simulator's arrays. */
  const uint32_t shape[] = {0, 1, 2, 0};
  const double x[] = {0, 0.3, 5, 5.5}, y[] = {0, 0.2, 5, 5}, heading[] = {0, 1.5, 3, 0};
  bch_agents agents = BCH_AGENTS_INIT;
  agents.shape = shape, agents.x = x, agents.y = y, agents.heading = heading, agents.count = 4;

  bch_crowd_collider* collider = NULL;
  bch_index_rows colliding;
  check(bch_crowd_collider_create(&collider));
  check(bch_crowd_collider_collide_all(collider, set, &agents, NULL, NULL, &colliding, NULL));
  for (size_t agent = 0; agent < colliding.rows; ++agent) {
    const uint64_t begin = colliding.offsets[agent], end = colliding.offsets[agent + 1];
    printf("agent %u collides with %u others:", (unsigned)agent, (unsigned)(end - begin));
    for (uint64_t i = begin; i < end; ++i) printf(" %" PRIu32, colliding.values[i]);
    printf("\n");
  }

  bch_crowd_collider_free(collider);
  bch_shape_set_free(set);
  bch_shape_set_builder_free(builder);
  bch_character_free(man);
  return 0;
}
