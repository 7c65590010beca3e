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

/// Writes a script, and those that it loads.
void write_script(const std::filesystem::path& folder, std::string_view name) {
  constexpr std::string_view load = "load \"";
  for (const ChartScript& script : chart_scripts()) {
    if (script.name != name) continue;
    cli::write_file(folder / (std::string(name) + ".gp"), script.text);
    for (std::size_t at = 0; (at = script.text.find(load, at)) != std::string_view::npos;) {
      at += load.size();
      write_script(folder, script.text.substr(at, script.text.find(".gp", at) - at));
    }
  }
}

}  // namespace

bool can_draw() {
  return run_gnuplot("/", {"-e", "set terminal svg"});
}

bool draw(const std::filesystem::path& folder, std::string_view name) {
  write_script(folder, name);
  return run_gnuplot(folder, {std::string(name) + ".gp"});
}

std::string embedded_picture(const std::filesystem::path& folder, const std::string& name) {
  std::ifstream stream(folder / (name + ".svg"));
  std::string svg{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) return {};
  svg.erase(0, begin);
  // Several pictures of a page must not share identifiers.
  for (const std::string quote : {"'", "\""}) {
    replace_all(svg, "id=" + quote, "id=" + quote + name + "-");
    replace_all(svg, "href=" + quote + "#", "href=" + quote + "#" + name + "-");
  }
  replace_all(svg, "url(#", "url(#" + name + "-");
  return svg;
}

}  // namespace bch::report
