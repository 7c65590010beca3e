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
  bch_shape_set* people = NULL;
  check(bch_character_default(BCH_MALE, &man));
  const bch_character* const characters[] = {man};
  check(bch_bake(characters, 1, 3, NULL, NULL, &people));

  /* Your simulator's arrays. */
  const uint32_t shape[] = {0, 1, 2, 0};
  const double x[] = {0, 0.3, 5, 5.5}, y[] = {0, 0.2, 5, 5}, heading[] = {0, 1.5, 3, 0};
  bch_agents agents = BCH_AGENTS_INIT;
  agents.shape = shape, agents.x = x, agents.y = y, agents.heading = heading, agents.count = 4;

  bch_crowd* crowd = NULL;
  const bch_pair* colliding;
  size_t count;
  check(bch_crowd_create(NULL, &crowd));
  check(bch_crowd_collisions(crowd, people, &agents, NULL, NULL, &colliding, &count));
  for (size_t i = 0; i < count; ++i)
    printf("%" PRIu32 " collides with %" PRIu32 "\n", colliding[i].first, colliding[i].second);

  bch_crowd_free(crowd);
  bch_shape_set_free(people);
  bch_character_free(man);
  return 0;
}
