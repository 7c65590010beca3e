// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/ply.hpp"

#include <assimp/fast_atof.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include "layout/base/shortest.hpp"
#include "layout/import/files.hpp"
#include "layout/import/scene.hpp"
#include "layout/import/text.hpp"

namespace bch::detail::importing {
namespace {

std::string in_quotes(std::string_view word) {
  return std::string("'").append(word).append("'");
}

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct NamedType {
  std::string_view name, sized_name;
  Type type;
  std::size_t bytes;
};
constexpr NamedType types[] = {
    {"char", "int8", Type::int8, 1},        {"uchar", "uint8", Type::uint8, 1},
    {"short", "int16", Type::int16, 2},     {"ushort", "uint16", Type::uint16, 2},
    {"int", "int32", Type::int32, 4},       {"uint", "uint32", Type::uint32, 4},
    {"float", "float32", Type::float32, 4}, {"double", "float64", Type::float64, 8},
};

struct Property {
  std::string_view name;
  Type type;
  std::optional<Type> size;  ///< of a list: the type of its size
};

struct Element {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Format { text, little_endian, big_endian };

/// The lines before the data. All end as the first does, but for a carriage return before a line feed, which is a blank.
class Header {
 public:
  Header(const std::filesystem::path& file, std::string_view bytes) : file_(file), rest_(bytes) {
    const std::size_t end = bytes.find_first_of("\r\n");
    const bool feeds = bytes.substr(std::min(end, bytes.size())).starts_with("\r\n");
    line_end_ = feeds || end == std::string_view::npos ? '\n' : bytes[end];
    next_line();
    while (read_line(next_line()))
      if (rest_.empty()) reject("the header has no end");
    if (!format_) reject("the header names no format");
  }

  Format format() const { return *format_; }
  const std::vector<Element>& elements() const { return elements_; }
  std::string_view data() const { return rest_; }

 private:
  const std::filesystem::path& file_;
  std::string_view rest_;
  char line_end_;
  std::size_t line_ = 0;
  std::optional<Format> format_;
  std::vector<Element> elements_;

  [[noreturn]] void reject(const std::string& reason) const {
    importing::reject(file_, "line " + std::to_string(line_) + ": " + reason);
  }

  std::string_view next_line() {
    const std::string_view line = rest_.substr(0, rest_.find(line_end_));
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    ++line_;
    return line;
  }

  /// Returns: whether a further line follows.
  bool read_line(std::string_view line) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
    if (words[0] == "end_header") return false;
    if (words[0] == "format" && words.size() > 1) {
      format_ = format_of(words[1]);
    } else if (words[0] == "element" && words.size() == 3) {
      elements_.push_back({words[1], count_of(words[2]), {}});
    } else if (words[0] == "property" && !elements_.empty() && words.size() == 3) {
      add({words[2], type_of(words[1]), {}});
    } else if (words[0] == "property" && !elements_.empty() && words.size() == 5 && words[1] == "list") {
      add({words[4], type_of(words[3]), type_of(words[2])});
    } else {
      reject(in_quotes(line) + " is no line of a PLY header");
    }
    return true;
  }

  void add(const Property& property) {
    constexpr std::size_t most = 1000;
    if (elements_.back().properties.size() == most) reject("an element has more than 1000 properties");
    for (const Property& other : elements_.back().properties)
      if (other.name == property.name) reject(in_quotes(property.name) + " is a property twice");
    elements_.back().properties.push_back(property);
  }

  Format format_of(std::string_view name) const {
    if (name == "ascii") return Format::text;
    if (name == "binary_little_endian") return Format::little_endian;
    if (name == "binary_big_endian") return Format::big_endian;
    reject(in_quotes(name) + " is no format of PLY");
  }
  Type type_of(std::string_view name) const {
    for (const NamedType& type : types)
      if (name == type.name || name == type.sized_name) return type.type;
    reject(in_quotes(name) + " is no type of PLY");
  }
  std::uint64_t count_of(std::string_view word) const {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size()) reject(in_quotes(word) + " is no count");
    return number;
  }
};

/// What assimp throws of a word that is none; its own error is not in its library.
struct NoNumber {
  template <class... Text>
  explicit NoNumber(const Text&...) {}
};

/// The values behind the header, one after the other.
class Data {
 public:
  Data(const std::filesystem::path& file, std::string_view bytes, Format format)
      : file_(file), rest_(bytes), format_(format) {}

  /// Is called before the values of an element's instance.
  void begin(const Element& element, std::uint64_t index) {
    element_ = &element;
    index_ = index;
  }
  /// What else stands in the line of text belongs to nothing.
  void end() {
    if (format_ == Format::text) rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size()));
  }

  double next(Type type) { return format_ == Format::text ? next_word_as(type) : next_bytes_as(type); }

  std::size_t next_size(Type type) {
    const double size = next(type);
    if (!(size >= 0 && size <= 0xffffffff && size == std::floor(size)))
      reject("has a list of " + shortest(size));
    return static_cast<std::size_t>(size);
  }

  [[noreturn]] void reject(const std::string& reason) const {
    importing::reject(file_, std::string(element_->name) + " " + std::to_string(index_) + " of " +
                                 std::to_string(element_->count) + " " + reason);
  }

 private:
  const std::filesystem::path& file_;
  std::string_view rest_;
  Format format_;
  const Element* element_ = nullptr;
  std::uint64_t index_ = 0;

  /// Reads numbers as assimp does, so that they are the same to the last bit.
  double next_word_as(Type type) {
    const std::string word(next_word(rest_));
    if (word.empty()) reject("is not there: the file ends before it");
    const char* end = word.c_str();
    float single = 0;
    double number = 0;
    try {
      if (type == Type::float32)
        end = Assimp::fast_atoreal_move<float, NoNumber>(end, single);
      else
        end = Assimp::fast_atoreal_move<double, NoNumber>(end, number);
    } catch (const NoNumber&) {
    }
    if (end != word.c_str() + word.size()) reject("has '" + word + "' for a number");
    return type == Type::float32 ? static_cast<double>(single) : number;
  }

  double next_bytes_as(Type type) {
    switch (type) {
      case Type::int8:
        return next_bytes<std::int8_t>();
      case Type::uint8:
        return next_bytes<std::uint8_t>();
      case Type::int16:
        return next_bytes<std::int16_t>();
      case Type::uint16:
        return next_bytes<std::uint16_t>();
      case Type::int32:
        return next_bytes<std::int32_t>();
      case Type::uint32:
        return next_bytes<std::uint32_t>();
      case Type::float32:
        return static_cast<double>(next_bytes<float>());
      default:
        return next_bytes<double>();
    }
  }

  template <class Number>
  Number next_bytes() {
    std::array<char, sizeof(Number)> bytes;
    if (rest_.size() < bytes.size()) reject("is not there: the file ends before it");
    std::copy_n(rest_.begin(), bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    const bool little = std::endian::native == std::endian::little;
    if (little != (format_ == Format::little_endian)) std::ranges::reverse(bytes);
    return std::bit_cast<Number>(bytes);
  }
};

using Corners = std::vector<std::uint32_t>;
constexpr std::uint32_t no_vertex = 0xffffffff;  // in a strip: what follows is a new one

struct Mesh {
  std::vector<aiVector3D> vertices;
  Corners corners;  ///< of one face behind the other
  std::vector<std::size_t> ends;

  void add_face(const Corners& face) {
    corners.insert(corners.end(), face.begin(), face.end());
    ends.push_back(corners.size());
  }

  /// Faces of a strip turn the same way.
  void add_strip(const Corners& strip) {
    std::size_t start = 0;
    for (std::size_t i = 0; i < strip.size(); ++i) {
      if (strip[i] == no_vertex) {
        start = i + 1;
      } else if (i >= start + 2) {
        const std::size_t odd = (i - start) % 2;
        add_face({strip[i - 2 + odd], strip[i - 1 - odd], strip[i]});
      }
    }
  }
};

void read_element(const Element& element, Data& data, Mesh& mesh) {
  if (element.properties.empty()) return;
  constexpr std::string_view axes[] = {"x", "y", "z"};
  Corners corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    data.begin(element, i);
    aiVector3D vertex;
    corners.clear();
    for (const Property& property : element.properties) {
      const bool names_corners = property.name == "vertex_indices" || property.name == "vertex_index";
      const std::size_t values = property.size ? data.next_size(*property.size) : 1;
      for (std::size_t v = 0; v < values; ++v) {
        const double value = data.next(property.type);
        const auto axis = std::ranges::find(axes, property.name) - axes;
        if (property.size && names_corners && value != std::floor(value))
          data.reject("has a corner " + shortest(value));
        if (property.size && names_corners)
          corners.push_back(value >= 0 && value < no_vertex ? static_cast<std::uint32_t>(value) : no_vertex);
        else if (!property.size && axis < 3)
          vertex[static_cast<unsigned>(axis)] = static_cast<float>(value);
      }
    }
    data.end();
    if (element.name == "vertex") mesh.vertices.push_back(vertex);
    if (element.name == "face") mesh.add_face(corners);
    if (element.name == "tristrips") mesh.add_strip(corners);
  }
}

std::unique_ptr<aiScene, SceneDeleter> scene_of(const Mesh& mesh) {
  std::unique_ptr<aiScene, SceneDeleter> scene(new aiScene);
  scene->mRootNode = new aiNode;
  scene->mRootNode->mMeshes = new unsigned[1]{0};
  scene->mRootNode->mNumMeshes = 1;
  scene->mMeshes = new aiMesh* [1] {};
  scene->mNumMeshes = 1;
  aiMesh& made = *(scene->mMeshes[0] = new aiMesh);
  made.mVertices = new aiVector3D[mesh.vertices.size()];
  made.mNumVertices = static_cast<unsigned>(mesh.vertices.size());
  std::ranges::copy(mesh.vertices, made.mVertices);
  made.mFaces = new aiFace[mesh.ends.size()];
  made.mNumFaces = static_cast<unsigned>(mesh.ends.size());
  auto corner = mesh.corners.begin();
  for (std::size_t f = 0; f < mesh.ends.size(); ++f) {
    const auto end = mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.ends[f]);
    made.mFaces[f].mNumIndices = static_cast<unsigned>(end - corner);
    made.mFaces[f].mIndices = new unsigned[made.mFaces[f].mNumIndices];
    std::copy(corner, end, made.mFaces[f].mIndices);
    corner = end;
  }
  return scene;
}

}  // namespace

bool is_ply(const std::filesystem::path& file) {
  std::string start(7, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  std::string_view word = start;
  if (word.starts_with(byte_order_mark)) word.remove_prefix(byte_order_mark.size());
  return (word.starts_with("ply") || word.starts_with("PLY")) &&
         (word[3] == '\r' || word[3] == '\n' || word[3] == ' ');
}

std::unique_ptr<aiScene, SceneDeleter> read_ply(const std::filesystem::path& file) {
  FileAndSiblings files(file);
  const std::string bytes = files.read(file);
  const Header header(file, bytes);
  Data data(file, header.data(), header.format());
  Mesh mesh;
  for (const Element& element : header.elements()) read_element(element, data, mesh);
  return scene_of(mesh);
}

}  // namespace bch::detail::importing
