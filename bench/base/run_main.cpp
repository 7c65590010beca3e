// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/exit_codes.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

#include <bch/files.hpp>
#include <bch/import.hpp>

#include "bench/base/system.hpp"
#include "bench/base/text.hpp"
#include "layout/recordings/trajectory.hpp"

namespace bch::cli {

int run_main(const char* program, const std::function<int()>& run) {
  const auto report = [&](int code, const std::string& message) {
    std::fprintf(stderr, "%s: %s\n", program, printable_line(message).c_str());
    return code;
  };
  try {
    prepare_process();
    return run();
  } catch (const UsageError& error) {
    return report(exit_usage, error.what());
  } catch (const CheckFailed& error) {
    return report(exit_failed, error.what());
  } catch (const detail::TrajectoryError& error) {
    return report(exit_bad_input, error.what());
  } catch (const InputError& error) {
    return report(exit_bad_input, error.what());
  } catch (const InputErrors& errors) {
    for (const std::string& line : errors.lines) report(exit_bad_input, line);
    return exit_bad_input;
  } catch (const ImportError& error) {
    return report(exit_bad_input, error.what());
  } catch (const BakedFileError& error) {
    return report(exit_bad_input, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return report(exit_bad_input, error.path1().string() + ": " + error.code().message());
  } catch (const std::bad_alloc&) {
    return report(exit_internal, "not enough memory");
  } catch (const std::exception& error) {
    return report(exit_internal, std::string("internal error: ") + error.what());
  }
}

}  // namespace bch::cli
