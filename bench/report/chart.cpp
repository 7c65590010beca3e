// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/chart.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <vector>

#include "bench/base/output.hpp"
#include "bench/report/embedded.hpp"

namespace bch::report {
namespace {

constexpr const char* nowhere = "/dev/null";

/// Runs gnuplot in a folder. Returns: whether it succeeded.
bool run_gnuplot(const std::filesystem::path& folder, std::vector<std::string> arguments) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, nowhere, O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, nowhere, O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, nowhere, O_WRONLY, 0);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string program = "gnuplot";
  std::vector<char*> argv{program.data()};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return failed == 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// Several pictures of a page must not share identifiers.
std::string for_a_page(std::string svg, const std::string& prefix) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) return {};
  svg.erase(0, begin);
  for (const std::string quote : {"'", "\""}) {
    replace_all(svg, "id=" + quote, "id=" + quote + prefix + "-");
    replace_all(svg, "href=" + quote + "#", "href=" + quote + "#" + prefix + "-");
  }
  replace_all(svg, "url(#", "url(#" + prefix + "-");
  return svg;
}

}  // namespace

bool can_draw() {
  return run_gnuplot("/", {"-e", "set terminal svg"});
}

void write_chart_scripts(const std::filesystem::path& folder) {
  for (const ChartScript& script : chart_scripts())
    cli::write_file(folder / (std::string(script.name) + ".gp"), script.text);
}

std::optional<std::string> draw(const std::filesystem::path& folder, std::string_view name) {
  const std::string script = std::string(name) + ".gp", picture = std::string(name) + ".svg";
  if (!run_gnuplot(folder, {script})) return std::nullopt;
  std::ifstream stream(folder / picture);
  const std::string svg = for_a_page({std::istreambuf_iterator<char>(stream), {}}, std::string(name));
  if (svg.empty()) return std::nullopt;
  return svg;
}

}  // namespace bch::report
