// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>

namespace bch::test {

/// What a file of JuPedSim is made of.
struct JuPedSimFile {
  std::string version = "2", fps = "25.0";
  std::string trajectory =
      "CREATE TABLE trajectory_data(frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL, pos_y "
      "REAL NOT NULL, "
      "ori_x REAL NOT NULL, ori_y REAL NOT NULL);";
  std::string rows = "(0,1,1.5,2,0,1),(0,2,3,4,0,0),(1,1,1.75,2,-1,0)";
  std::string geometry =
      "CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL);"
      "CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"
      "INSERT INTO geometry VALUES(-7,'POLYGON ((0 0, 1 0, 1 1, 0 0))');"
      "INSERT INTO frame_data VALUES(0,-7),(1,-7);";

  /// Statements that make it.
  std::string sql() const {
    return "CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"
           "INSERT INTO metadata VALUES('version','" +
           version + "'),('fps','" + fps + "');" + trajectory + geometry +
           (rows.empty() ? "" : "INSERT INTO trajectory_data VALUES" + rows + ";") +
           "CREATE INDEX frame_id_idx ON trajectory_data(frame, id);";
  }
};

}  // namespace bch::test
