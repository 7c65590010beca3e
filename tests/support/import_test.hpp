// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include "layout/character/eigen.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_folder.hpp"

namespace bch::test {

/// Imports files of which a test gives the bytes, or says why they are refused.
class ImportTest : public testing::Test {
 protected:
  TemporaryFolder folder;

  ImportedCharacter import(const std::string& name, const std::string& bytes,
                           const ImportOptions& options = {}) const {
    ImportedCharacter imported = import_character(folder.write(name, bytes), options);
    validate(imported.character);
    return imported;
  }

  /// Returns the message of an error, without the folder's name; "accepted" where there is none. Expects that it is one line, begins with
  /// the name of a file there, and nothing is printed.
  std::string complaint(const std::filesystem::path& file, const ImportOptions& options = {}) const {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const std::string message =
        test::complaint<ImportError>([&] { validate(import_character(file, options).character); });
    EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    if (message == "accepted") return message;
    EXPECT_TRUE(message.starts_with(folder.path().string())) << message;
    return message.substr(std::min(folder.path().string().size() + 1, message.size()));
  }
  std::string complaint(const std::string& name, const std::string& bytes,
                        const ImportOptions& options = {}) const {
    return complaint(folder.write(name, bytes), options);
  }
};

/// Likewise of glTF files.
class ImportGltf : public ImportTest {
 protected:
  ImportedCharacter import(const std::string& text) const { return ImportTest::import("file.gltf", text); }
  void expect_error(const std::string& text, const std::string& reason) const {
    EXPECT_TRUE(has(complaint("file.gltf", text), reason));
  }
};

/// Options of files that are in metres, with z up.
inline ImportOptions as_it_is() {
  ImportOptions options;
  options.up = ImportOptions::UpAxis::z;
  options.scale = 1.0f;
  return options;
}

inline testing::AssertionResult has_note(const ImportReport& report, const std::string& part) {
  std::string all;
  for (const std::string& note : report.notes) {
    if (note.find(part) != std::string::npos) return testing::AssertionSuccess() << note;
    all += "\n" + note;
  }
  return testing::AssertionFailure() << "no '" << part << "' in the notes:" << all;
}

/// Returns how far the vertices of two characters are from each other at most, in a pose of each.
inline float farthest_apart(const Character& a, PoseTime at, const Character& b, PoseTime other) {
  detail::Skinner of_a(a), of_b(b);
  const auto pose_a = of_a.pose(at), pose_b = of_b.pose(other);
  EXPECT_EQ(pose_a.size(), pose_b.size());
  float farthest = 0;
  for (std::size_t v = 0; v < std::min(pose_a.size(), pose_b.size()); ++v)
    farthest = std::max(farthest, (detail::to_eigen(pose_a[v]) - detail::to_eigen(pose_b[v])).norm());
  return farthest;
}

/// Returns the same for the worst of some poses of clips, at the same shares of their times.
inline float farthest_in_clips(const Character& a, std::uint32_t clip, const Character& b,
                               std::uint32_t other) {
  float farthest = 0;
  for (const float fraction : {0.0f, 0.1f, 0.3f, 0.35f, 0.5f, 0.7f, 0.9f, 1.0f})
    farthest = std::max(farthest, farthest_apart(a, PoseTime{clip, fraction * a.clips.at(clip).seconds}, b,
                                                 PoseTime{other, fraction * b.clips.at(other).seconds}));
  return farthest;
}

}  // namespace bch::test
