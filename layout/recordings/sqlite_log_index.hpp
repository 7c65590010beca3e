// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <sqlite3.h>

#include <memory>

// Private to the readers of recordings: the index of a SQLite file's write-ahead log.

namespace bch::detail::trajectory {

/// Makes a database that was just opened keep the index of its log in memory, instead of in a file beside it, where others that have the
/// log open would search for it. The caller sees to it that there are none, and keeps what is returned until the database is closed.
std::shared_ptr<void> keep_log_index_in_memory(sqlite3* database);

}  // namespace bch::detail::trajectory
