// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <windows.h>

namespace {

/// Keeps the library loaded to the end of the program, as its linker's option does elsewhere.
const bool stays = [] {
  HMODULE self;
  return GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_PIN | GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS,
                            reinterpret_cast<LPCWSTR>(&stays), &self) != 0;
}();

}  // namespace
