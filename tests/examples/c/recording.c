/* SPDX-License-Identifier: MIT
 * Copyright (c) 2026 the bch authors */

/* Who runs into whom in a recording? Usage: recording FILE FPS UNIT */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include <bch/bch_files.h>

static void check(bch_status status) {
  if (status == BCH_OK) return;
  fprintf(stderr, "%s: %s\n", bch_status_name(status), bch_last_error());
  exit(1);
}

int main(int argc, char** argv) {
  if (argc != 4) return fprintf(stderr, "usage: recording FILE FPS UNIT\n"), 2;
  bch_trajectory_options options = BCH_TRAJECTORY_OPTIONS_INIT;
  options.fps = atof(argv[2]), options.unit = atof(argv[3]);
  bch_trajectory* recording = NULL;
  check(bch_trajectory_open(argv[1], &options, &recording));
  bch_trajectory_info info = BCH_TRAJECTORY_INFO_INIT;
  check(bch_trajectory_get_info(recording, &info));

  bch_check* found = NULL;
  const bch_check_event* events = NULL;
  size_t count = 0;
  bch_check_summary summary = BCH_CHECK_SUMMARY_INIT;
  check(bch_check_run(recording, NULL, &found));
  check(bch_check_get_summary(found, &summary));
  check(bch_check_get_events(found, &events, &count));
  printf("%" PRIu64 " rows, %" PRIu64 " frames\n", info.rows, summary.frames);
  for (size_t i = 0; i < count; ++i)
    printf("%" PRId64 " and %" PRId64 ": frames %" PRId64 " to %" PRId64 "\n", events[i].first, events[i].second,
           events[i].from, events[i].to);

  bch_check_free(found);
  bch_trajectory_free(recording);
  return 0;
}
