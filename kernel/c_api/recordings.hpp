// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/bch_files.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernel/c_api/failure.hpp"
#include "layout/recordings/trajectory.hpp"

struct bch_trajectory {
  std::unique_ptr<bch::detail::TrajectoryReader> reader;
  std::string assumptions, notes;         ///< a line each
  std::vector<bch_named_motion> motions;  ///< whose texts are the reader's
  std::vector<bch_named_body> bodies;     ///< of the motions, likewise
  bch_status fault = BCH_BAD_FILE;        ///< what a recording that is wrong is
  bool is_read = false;                   ///< some of it
  std::int64_t frame = 0;                 ///< of the people who wait
  std::vector<bch::detail::TrackedPerson> waiting = {};
};

struct bch_check {
  std::vector<bch_check_frame> frames;
  std::vector<bch_check_pair> pairs;
  std::vector<bch_check_event> events;
  std::vector<bch_check_density> densities;
  std::vector<bch_check_measure> measures;
  std::vector<bch_check_conflict> conflicts;
  bch_check_summary summary = BCH_CHECK_SUMMARY_INIT;
  std::string assumptions, notes;  ///< a line each
  std::string page;                ///< or empty
};

namespace bch::c_api {

/// Checks a recording. It is made of the kernel's code, which is in libbch.so alone: that library has this function for libbch_files.so.
std::unique_ptr<bch_check> run_check(bch_trajectory& trajectory, const bch_check_options& given);

}  // namespace bch::c_api
