// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>

#include "bench/workload/scene.hpp"

namespace bch::bench {

/// Judges a ratio: "PASS", or by how much it misses what it needs: "needs 20: 19 % short".
std::string verdict(double ratio, double needed);
/// Judges a value that must not exceed `most`: "PASS", or "at most 1.5: 8 % over".
std::string verdict_at_most(double value, double most);

/// Each of these functions prints a table to standard output.
void print_kernel_ratios(Scene& scene, std::uint32_t runs);
void print_leaf_ratios(Scene& scene, std::uint32_t runs);
void print_peer_ratios(Scene& scene, std::uint32_t runs);
void print_call_ratios(Scene& scene, std::uint32_t runs);
void print_crowd_ratios(Scene& scene, std::uint32_t runs);
void print_distance_ratios(Scene& scene, std::uint32_t runs);
void print_response_ratios(Scene& scene, std::uint32_t runs);
void print_shape_count_ratios(Scene& scene, std::uint32_t runs, std::uint32_t most_shapes);
void print_plan_table(Scene& scene, std::uint32_t runs);
/// Prints the times of construction: every stage by every instruction set beside what is required, and the
/// growth with triangles.
void print_build_ratios(Scene& scene, std::uint32_t runs);
void print_build_growth(std::uint32_t poses, std::uint32_t runs);
void print_paper_table(Scene& scene, std::uint32_t runs);

}  // namespace bch::bench
