// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdio>
#include <regex>

#include "tests/support/program_run.hpp"
#include "tests/support/test.hpp"

// What must hold of the sources and the object files themselves, and of what chapters show, which is what runs. BCH_OBJECTS: the libraries' objects,
// BCH_SOURCE: the repository.

namespace {

namespace fs = std::filesystem;
using bch::test::read_text;

std::string output_of(const std::string& command) {
  std::string output;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 4096> buffer;
  while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), size);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return output;
}

std::vector<fs::path> objects() {
  std::vector<fs::path> paths;
  std::istringstream list(read_text(BCH_OBJECTS));
  for (std::string path; std::getline(list, path);) paths.emplace_back(path);
  return paths;
}

bool is_wide(const fs::path& object) {
  const std::string name = object.filename().string();
  return name.find("avx") != std::string::npos;
}

/// Where users' headers are: those of shapes and queries, and that of the crowd on MPI, which is a component of its own.
constexpr const char *layout_headers = "layout/include/", *kernel_headers = "kernel/include/",
                     *mpi_headers = "kernel/distributed/include/";

/// Each source file's includes. Public headers, written <bch/...>, by where they are.
std::map<fs::path, std::vector<std::string>> includes_below(const std::string& folder) {
  static const std::regex include(R"re(#include\s*[<"]([^>"]+)[>"])re");
  std::map<fs::path, std::vector<std::string>> includes;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(BCH_SOURCE) / folder)) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
    const std::string text = read_text(entry.path());
    for (auto match = std::sregex_iterator(text.begin(), text.end(), include);
         match != std::sregex_iterator(); ++match) {
      std::string name = (*match)[1];
      for (const std::string library : {layout_headers, kernel_headers, mpi_headers})
        if (name.starts_with("bch/") && fs::exists(fs::path(BCH_SOURCE) / (library + name)))
          name = library + name;
      includes[entry.path()].push_back(name);
    }
  }
  return includes;
}

void expect_no_include(const std::string& folder, const std::string& forbidden,
                       const std::string& but_in = "^$") {
  const std::regex pattern("^(" + forbidden + ")"), exempt(but_in);
  std::size_t files = 0;
  for (const auto& [file, includes] : includes_below(folder)) {
    ++files;
    if (std::regex_search(fs::relative(file, fs::path(BCH_SOURCE) / folder).string(), exempt)) continue;
    for (const std::string& include : includes)
      EXPECT_FALSE(std::regex_search(include, pattern)) << file << " includes " << include;
  }
  EXPECT_GT(files, 0u) << folder;
}

TEST(Layers, NothingLooksUp) {
  expect_no_include("layout", "kernel/|baselines/|bench/|tests/");
  expect_no_include("kernel", "baselines/|bench/|tests/");
  expect_no_include("baselines", "kernel/|bench/|tests/");
}

TEST(Layers, LibrariesStayInTheirRooms) {
  expect_no_include("layout", "assimp/", "^import/");
  expect_no_include("layout", "polyclipping/");
  expect_no_include("layout", "xsimd/", "^simd/(batches|neon_arch|portable_arch)");
  expect_no_include("layout", "oneapi/tbb|tbb/");
  expect_no_include(
      "layout", "Eigen/|layout/character/eigen",
      "^(character|default_character|import)/.*cpp$|^character/(clip_pose|eigen|rotation_blend)|"
      "^default_character/(body|human)_|^import/(fbx_document|scene|units)");
  expect_no_include("layout", "zlib", "^import/fbx_record");
  expect_no_include("layout", "xxhash", "^baked/checksum");
  expect_no_include("layout", "sqlite3", "^recordings/sqlite_");
  expect_no_include("layout", "hdf5", "^recordings/hdf5_recording");
  expect_no_include("layout", "layout/recordings/", "^recordings/");
  expect_no_include("kernel", "(layout|kernel)/recordings/", "^recordings/|^c_api/");
  expect_no_include("kernel", "assimp/|Eigen/|polyclipping/");
  expect_no_include("kernel", "xsimd/");
  expect_no_include("baselines", "assimp/|xsimd/|oneapi/tbb|tbb/");
}

/// Numbers that files name may be such that std::hash, which returns them as they are, puts all into one bucket.
TEST(Layers, NumbersInHashTablesAreMixed) {
  const std::regex table(
      R"re(unordered_(map|set)<\s*(std::u?int|std::size_t|int\b|unsigned|long|Key\b)[^;]*;)re");
  std::size_t found = 0;
  for (const char* const top : {"layout", "kernel", "bench"})
    for (const auto& [path, includes] : includes_below(top)) {
      const std::string text = read_text(path);
      for (auto match = std::sregex_iterator(text.begin(), text.end(), table);
           match != std::sregex_iterator(); ++match) {
        EXPECT_NE(match->str().find("MixedHash"), std::string::npos) << path << ": " << match->str();
        ++found;
      }
    }
  EXPECT_GT(found, 0u);
}

TEST(Layers, FewFilesKnowTheProcessor) {
  // An empty one is for the compiler: it names none.
  const std::regex instruction(
      R"re(\b_mm\d*_|[a-z]mmintrin\.h|\bv[a-z]+q_[fsu]\d+\b|arm_neon\.h|\basm\b(?! volatile\("" ))re");
  const auto has_any = [](const std::string& text, const std::vector<std::string>& words) {
    return std::ranges::any_of(words, [&](const auto& word) { return text.find(word) != std::string::npos; });
  };
  const std::regex may_name_instructions("^layout/(simd/(x86|neon_arch)|base/floating_point_register)");
  const std::regex may_ask("^layout/(simd|base)/|^kernel/isa/");
  std::size_t found = 0;
  for (const char* const top : {"layout", "kernel", "baselines", "bench"})
    for (const auto& [path, includes] : includes_below(top)) {
      const std::string file = fs::relative(path, BCH_SOURCE).string(), text = read_text(path);
      const bool names_instructions =
          has_any(text, {"_mm", "q_", "mmintrin", "arm_neon", "asm"}) && std::regex_search(text, instruction);
      const bool asks =
          has_any(text, {"__x86_64", "__i386", "__amd64", "__aarch64", "__arm", "__riscv", "_M_X64", "_M_ARM",
                         "__SSE", "__AVX", "__ARM", "__builtin_cpu_", "__builtin_ia32_", "BCH_X86",
                         "BCH_NEON", "BCH_PORTABLE", "BCH_SCALAR"});
      EXPECT_FALSE(names_instructions && !std::regex_search(file, may_name_instructions)) << file;
      EXPECT_FALSE(asks && !std::regex_search(file, may_ask)) << file;
      found += names_instructions + asks;
    }
  EXPECT_GE(found, 6u);
}

/// What a program compiles without optimisation and with -ffast-math would take their place.
TEST(Layers, NumbersAreClassifiedByFunctionsOfOurs) {
  for (const char* const top : {"layout", "kernel"})
    for (const auto& [path, includes] : includes_below(top))
      EXPECT_FALSE(std::regex_search(read_text(path), std::regex(R"re(std::is(finite|inf|nan)\()re")))
          << path;
}

/// Folders include each other one way only: what is left when those that need no others are taken away, again and again, is a
/// cycle.
TEST(Layers, FoldersLookOneWay) {
  std::map<std::string, std::map<std::string, std::string>>
      needs;  // of each folder, others and a file that includes them
  for (const char* const top : {"layout", "kernel", "baselines", "bench", "tests"})
    for (const auto& [file, includes] : includes_below(top)) {
      const fs::path from = fs::relative(file, BCH_SOURCE);
      auto& others = needs[from.parent_path().string()];
      for (const std::string& include : includes)
        if (fs::exists(fs::path(BCH_SOURCE) / include) &&
            fs::path(include).parent_path() != from.parent_path())
          others.emplace(fs::path(include).parent_path().string(), from.string() + " includes " + include);
    }
  EXPECT_GT(needs.size(), 30u);
  for (bool taken = true; taken;) {
    taken = false;
    for (auto folder = needs.begin(); folder != needs.end();) {
      std::erase_if(folder->second, [&](const auto& other) { return !needs.contains(other.first); });
      const bool is_free = folder->second.empty();
      taken |= is_free;
      folder = is_free ? needs.erase(folder) : std::next(folder);
    }
  }
  for (const auto& [folder, others] : needs)
    for (const auto& [other, example] : others)
      ADD_FAILURE() << folder << " and " << other << ": " << example;
}

TEST(Layers, IsaFilesIncludeOnlyKernelTemplates) {
  const std::set<std::string> stems{"avx512", "avx2", "sse2", "neon", "scalar", "base"};
  std::size_t found = 0;
  for (const auto& [top, templates] :
       {std::pair("kernel", "kernel/isa/kernel_table.hpp"), {"layout", "layout/isa/build_loops.hpp"}})
    for (const auto& [file, includes] : includes_below(top)) {
      if (file.extension() != ".cpp" || !stems.contains(file.stem().string())) continue;
      ++found;
      EXPECT_EQ(includes, std::vector<std::string>{templates}) << file;
    }
  EXPECT_EQ(found, 7u);
}

std::map<std::string, std::string> public_headers(const std::vector<std::string>& folders) {
  std::map<std::string, std::string> texts;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::directory_iterator(fs::path(BCH_SOURCE) / folder / "bch"))
      texts[entry.path().filename().string()] = read_text(entry.path());
  return texts;
}

/// What a public header declares in bch, and whether a comment stands above it: lines that begin in the first column are
/// declarations.
std::map<std::string, bool> public_names(const std::string& header) {
  static const std::regex declared(
      R"(^(?:(?:struct|class|enum class) (\w+)(?: : [\w: ]+)?(?: final)? \{|using (\w+) =|(?! |namespace|template|//|\}|#)[\w:<>,&\* \[\]]*?[ &\*](\w+)(?:\(|\{|;| = )))");
  static const std::regex macro(R"(^#define (\w+))");
  std::map<std::string, bool> names;
  std::istringstream lines(header);
  bool detail = false, commented = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("namespace")) detail = line.find("detail") != std::string::npos;
    std::smatch match;
    if (std::regex_search(line, match, macro)) names[match[1]] = true;
    if (!detail && std::regex_search(line, match, declared))
      for (std::size_t i = 1; i < match.size(); ++i)
        if (match[i].matched) names[match[i]] = commented;
    if (!line.starts_with("template")) commented = line.starts_with("///");
  }
  return names;
}

/// tests/whole/public_surface.txt is what users rely on: a line a header, with all that it declares. Who changes one changes the
/// other, and CHANGELOG.md.
TEST(PublicSurface, IsWhatIsWrittenDown) {
  std::string surface;
  for (const auto& [name, text] : public_headers({layout_headers, kernel_headers, mpi_headers})) {
    surface += name + ":";
    for (const auto& [declared, commented] : public_names(text)) {
      surface += " " + declared;
      EXPECT_TRUE(commented) << name << ": " << declared << " has no comment";
    }
    surface += "\n";
  }
  EXPECT_EQ(surface, read_text(fs::path(BCH_SOURCE) / "tests/whole/public_surface.txt")) << surface;
  EXPECT_LE(public_headers({layout_headers, kernel_headers, mpi_headers}).size(), 22u);
  std::set<std::string> names;
  for (const auto& [header, text] : public_headers({layout_headers, kernel_headers}))
    for (const auto& [name, commented] : public_names(text))
      if (!name.starts_with("BCH_")) names.insert(name);
  EXPECT_LE(names.size(), 150u);
}

/// What is longer is in a chapter, such as kernel/accuracy.md.
TEST(PublicSurface, HasShortCommentsAndNarrowLines) {
  for (const auto& [name, text] : public_headers({layout_headers, kernel_headers, mpi_headers})) {
    std::istringstream lines(text);
    std::size_t number = 0, of_comment = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      const std::size_t first = line.find_first_not_of(' ');
      of_comment = first != line.npos && line.compare(first, 2, "//") == 0 ? of_comment + 1 : 0;
      EXPECT_LE(line.size(), 110u) << name << ":" << number;
      EXPECT_LE(of_comment, 8u) << name << ":" << number;
    }
    EXPECT_GT(number, 20u) << name;
  }
}

TEST(PublicSurface, NeedsTheStandardLibraryAlone) {
  std::size_t found = 0;
  const std::regex allowed("[a-z_]+|(layout|kernel)/include/bch/[a-z_]+\\.hpp");
  for (const std::string folder : {layout_headers, kernel_headers, mpi_headers})
    for (const auto& [file, includes] : includes_below(folder))
      for (const std::string& include : includes) {
        ++found;
        if (folder == mpi_headers && include == "mpi.h") continue;
        EXPECT_TRUE(std::regex_match(include, allowed)) << file << " includes " << include;
      }
  EXPECT_GT(found, 50u);
}

/// Private headers declare nothing in bch itself, but for what they name of it ahead.
TEST(PublicSurface, IsAllThatIsInTheNamespace) {
  const std::regex block(R"(\nnamespace bch \{\n([^}]*)\})"), ahead(R"((struct|class) \w+;)");
  std::size_t files = 0;
  for (const char* const folder : {"layout", "kernel"})
    for (const auto& [file, includes] : includes_below(folder)) {
      if (file.extension() != ".hpp" || file.parent_path().filename() == "bch") continue;
      ++files;
      const std::string text = read_text(file);
      for (auto found = std::sregex_iterator(text.begin(), text.end(), block);
           found != std::sregex_iterator(); ++found) {
        std::istringstream lines((*found)[1]);
        for (std::string line; std::getline(lines, line);)
          EXPECT_TRUE(line.empty() || std::regex_match(line, ahead)) << file << ": " << line;
      }
    }
  EXPECT_GT(files, 80u);
}

/// Code that could be shared with other objects: weak symbols that are not data.
std::set<std::string> weak_code(const fs::path& object) {
  std::set<std::string> symbols;
  std::istringstream lines(output_of("" BCH_NM " --defined-only '" + object.string() + "'"));
  for (std::string address, type, name; lines >> address >> type >> name;)
    if (type == "W" || type == "w" || type == "u" || type == "i") symbols.insert(name);
  return symbols;
}

TEST(Objects, NoCodeForWideRegistersCanReplaceOtherCode) {
  std::set<std::string> elsewhere;
  std::size_t wide = 0;
  for (const fs::path& object : objects())
    if (!is_wide(object)) elsewhere.merge(weak_code(object));
  EXPECT_FALSE(elsewhere.empty());
  for (const fs::path& object : objects()) {
    if (!is_wide(object)) continue;
    ++wide;
    const std::set<std::string> here = weak_code(object);
    for (const std::string& symbol : here)
      EXPECT_FALSE(elsewhere.contains(symbol)) << object << ": " << symbol;
#ifdef __OPTIMIZE__
    EXPECT_TRUE(here.empty()) << object << ": " << *here.begin();
#endif
  }
  EXPECT_EQ(wide, std::string(BCH_ISA_NAME) == "x86" ? 4u : 0u);
}

TEST(Objects, NoFunctionOfEigenIsSharedWithPrograms) {
  std::size_t ours = 0;
  for (const fs::path& object : objects()) {
    if (object.string().find("bch_baselines") != std::string::npos) continue;
    for (const std::string& symbol : weak_code(object)) {
      EXPECT_EQ(symbol.find("5Eigen"), std::string::npos) << object << ": " << symbol;
      ours += symbol.find("9bch_eigen") != std::string::npos;
    }
  }
  EXPECT_GT(ours, 0u);
}

TEST(Objects, NothingThatComputesAnAnswerFusesMultiplyAndAdd) {
  // One of each kind of instruction, fused ones and multiplications; grep takes a tenth of the time of std::regex.
  const std::string kinds =
      R"(grep -oE '\bvfn?m(add|sub)|\bfn?m(add|sub|l[as])\b|\bv?mulps|\bfmul\b' | sort -u)";
  std::size_t multiplications = 0;
  for (const fs::path& object : objects()) {
    std::istringstream found(
        output_of("" BCH_OBJDUMP " -d --no-show-raw-insn '" + object.string() + "' | " + kinds));
    for (std::string kind; std::getline(found, kind); ++multiplications)
      EXPECT_NE(kind.find("mul"), std::string::npos) << object << ": " << kind;
  }
  EXPECT_GE(multiplications, 2u);  // the disassembly is really looked at
}

#ifdef BCH_C_LIBRARY
/// The functions that a header of the C interface declares.
std::set<std::string> declared_in(const std::string& name) {
  const std::string header = read_text(fs::path(BCH_SOURCE) / "kernel/c_api/include/bch" / name);
  static const std::regex function(R"(\nBCH_API [\w *]*?\b(bch_\w+)\()");
  std::set<std::string> declared;
  for (auto match = std::sregex_iterator(header.begin(), header.end(), function);
       match != std::sregex_iterator(); ++match)
    declared.insert((*match)[1]);
  std::size_t marks = 0;
  for (std::size_t at = 0; (at = header.find("\nBCH_API ", at)) != std::string::npos; ++at) ++marks;
  EXPECT_EQ(declared.size(), marks);
  return declared;
}

/// The functions that a library exports, by the node of symbol versions, up to its number, that has them.
std::map<std::string, std::set<std::string>> exported_by(const std::string& library) {
  std::map<std::string, std::set<std::string>> exported;
  std::istringstream lines(output_of("" BCH_NM " -D --defined-only '" + library + "'"));
  for (std::string address, type, name; lines >> address >> type >> name;) {
    if (type == "A") continue;  // a node itself
    EXPECT_EQ(type, "T") << name;
    const std::size_t node = name.find("@@");
    exported[node == std::string::npos ? "" : name.substr(node + 2, name.rfind('_') - node - 2)].insert(
        name.substr(0, node));
  }
  return exported;
}

/// The shared libraries export what their headers declare: no more, no less. One thing aside: what the library of files needs
/// of the other one, which users cannot call by accident.
TEST(Objects, LibrariesExportTheFunctionsOfTheirHeaders) {
  auto first = exported_by(BCH_C_LIBRARY);
  EXPECT_GT(first["BCH"].size(), 50u);
  EXPECT_EQ(first["BCH"], declared_in("bch.h"));
  EXPECT_LE(first["BCH_PRIVATE"].size(), 10u);
  for (const std::string& name : first["BCH_PRIVATE"]) EXPECT_TRUE(name.starts_with("_ZN3bch5c_api")) << name;
  EXPECT_EQ(first.size(), 2u);
#ifdef BCH_C_FILES_LIBRARY
  auto files = exported_by(BCH_C_FILES_LIBRARY);
  EXPECT_EQ(files[""], declared_in("bch_files.h"));
  EXPECT_EQ(files.size(), 1u);
#endif
}

/// A program that asks for collisions alone loads no reader of files.
TEST(Objects, TheLibraryNeedsThreadsAlone) {
  std::istringstream lines(output_of("" BCH_OBJDUMP " -p '" BCH_C_LIBRARY "'"));
  const std::regex common(R"(lib(tbb|stdc\+\+|c\+\+(abi)?|unwind|m|gcc_s|c)\.so.*|ld-linux.*)");
  std::size_t found = 0;
  for (std::string word; lines >> word;) {
    if (word != "NEEDED") continue;
    lines >> word;
    ++found;
    EXPECT_TRUE(std::regex_match(word, common)) << word;
  }
  EXPECT_GE(found, 3u);
}
#endif

const fs::path source = BCH_SOURCE;

TEST(Readme, ShowsTheLinesThatCiRuns) {
  const std::string ci = read_text(source / ".ci/run");
  const std::string readme = read_text(source / "README.md");
  std::istringstream lines(ci);
  std::size_t found = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("apt-get update")) {
      ++found;
      EXPECT_NE(readme.find("\n" + line + "\n"), std::string::npos) << line;
    }
  EXPECT_EQ(found, 2u);
}

TEST(Readme, IsShort) {
  const std::string readme = read_text(source / "README.md");
  EXPECT_LE(std::count(readme.begin(), readme.end(), '\n'), 140);
  EXPECT_LE(readme.size(), 10'240u);
}

/// But for indentation; `install` runs the program.
TEST(Tutorial, ShowsPartsOfItsProgram) {
  const auto flush = [](const std::string& text) {
    return std::regex_replace(text, std::regex("\n +"), "\n");
  };
  const std::string program = flush(read_text(source / "tests/examples/consumer/tutorial.cpp"));
  const std::string chapter = read_text(source / "kernel/README.md");
  const std::size_t end = chapter.find("\n## ", chapter.find("\n## Tutorial") + 1);
  const std::string begin_of_part = "```cpp", end_of_part = "\n```";
  int parts = 0;
  for (std::size_t at = chapter.find(begin_of_part); at < end;
       at = chapter.find(begin_of_part, at), ++parts) {
    at += begin_of_part.size();
    const std::string part = flush(chapter.substr(at, chapter.find(end_of_part, at) - at));
    EXPECT_NE(program.find(part), std::string::npos) << part;
  }
  EXPECT_GE(parts, 6);
}

}  // namespace
