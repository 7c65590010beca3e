// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/hdf5_recording.hpp"

#include <hdf5.h>
#include <stdlib.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace bch::detail::trajectory {
namespace {

constexpr const char* dataset_name = "trajectory";
constexpr std::size_t longest_text = std::size_t{1} << 24;
constexpr std::size_t largest_chunk = std::size_t{1} << 25;  // bytes
constexpr std::size_t largest_record = 4096;                 // likewise

[[noreturn]] void reject(const std::string& reason) {
  throw std::runtime_error(reason);
}

herr_t keep_reason(unsigned depth, const H5E_error2_t* error, void* reason) {
  if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(reason) = error->desc;
  return 0;
}

/// Throws what the library says is wrong.
[[noreturn]] void fail(const std::string& what) {
  std::string reason = "malformed";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_reason, &reason);
  reject(what + ": " + reason);
}

/// An object of the library, closed when this goes.
class Handle {
 public:
  using Closing = herr_t (*)(hid_t);
  Handle(hid_t id, Closing closing, const char* what) : id_(id), closing_(closing) {
    if (id_ < 0) fail(what);
  }
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), closing_(other.closing_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) closing_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Closing closing_;
};

bool is_one_of(hid_t type, std::initializer_list<hid_t> types) {
  return std::any_of(types.begin(), types.end(), [&](hid_t known) { return H5Tequal(type, known) > 0; });
}

/// Whether a type is of whole bytes, in one of the two orders.
bool is_plain_integer(hid_t type) {
  return is_one_of(type,
                   {H5T_STD_I8LE, H5T_STD_I16LE, H5T_STD_I32LE, H5T_STD_I64LE, H5T_STD_U8LE, H5T_STD_U16LE,
                    H5T_STD_U32LE, H5T_STD_U64LE, H5T_STD_I8BE, H5T_STD_I16BE, H5T_STD_I32BE, H5T_STD_I64BE,
                    H5T_STD_U8BE, H5T_STD_U16BE, H5T_STD_U32BE, H5T_STD_U64BE});
}
bool is_plain_float(hid_t type) {
  return is_one_of(type, {H5T_IEEE_F32LE, H5T_IEEE_F64LE, H5T_IEEE_F32BE, H5T_IEEE_F64BE});
}

Handle open_file(const std::string& file) {
  setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);  // nothing is written, and some file systems have no locks
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "HDF5");
  H5Pset_fapl_sec2(access);
  // Rows are read one after the other. A chunk that does not fit would be inflated for every part of it that is read.
  constexpr std::size_t slots = 521;  // HDF5's default
  H5Pset_cache(access, 0, slots, largest_chunk, 1);
  return {H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose, "cannot be read by HDF5"};
}

/// Opens the dataset, which has to lie in the file itself.
Handle open_dataset(hid_t file) {
  if (H5Lexists(file, dataset_name, H5P_DEFAULT) <= 0) reject("has no dataset 'trajectory'");
  H5L_info_t link;
  if (H5Lget_info(file, dataset_name, &link, H5P_DEFAULT) < 0)
    fail("the dataset 'trajectory' cannot be read");
  if (link.type != H5L_TYPE_HARD) reject("'trajectory' is a link to elsewhere");
  return {H5Dopen2(file, dataset_name, H5P_DEFAULT), H5Dclose, "'trajectory' is no dataset"};
}

void check_filters(hid_t creation) {
  const int filters = H5Pget_nfilters(creation);
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0, config = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &values, nullptr, 0, nullptr, &config);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_FLETCHER32)
      reject("the dataset 'trajectory' uses filter " + std::to_string(filter) +
             "; deflate, shuffle and fletcher32 are read");
  }
}

void check_storage(hid_t dataset, std::size_t record) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose, "the dataset 'trajectory' cannot be read");
  const H5D_layout_t layout = H5Pget_layout(creation);
  if (layout != H5D_COMPACT && layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED)
    reject("the dataset 'trajectory' is virtual");
  if (H5Pget_external_count(creation) != 0) reject("the dataset 'trajectory' lies in other files");
  check_filters(creation);
  hsize_t chunk = 0;
  if (layout == H5D_CHUNKED && (H5Pget_chunk(creation, 1, &chunk) != 1 || chunk > largest_chunk / record))
    reject("the dataset 'trajectory' has chunks of more than 32 MiB");
}

Handle member_type(hid_t record, const char* name) {
  return {H5Tget_member_type(record, static_cast<unsigned>(H5Tget_member_index(record, name))), H5Tclose,
          "HDF5"};
}

bool has_member(hid_t record, const char* name) {
  return H5Tget_member_index(record, name) >= 0;
}

/// Whether records say where people face.
bool has_orientation(hid_t record) {
  return has_member(record, "ox") && has_member(record, "oy");
}

/// Checks the members of a record.
void check_type(hid_t type) {
  if (H5Tget_class(type) != H5T_COMPOUND) reject("the dataset 'trajectory' does not consist of records");
  if (H5Tget_size(type) > largest_record) reject("the records of 'trajectory' have more than 4096 bytes");
  std::vector<std::string> names{"id", "frame", "x", "y", "z"};
  if (has_orientation(type)) names.insert(names.end(), {"ox", "oy"});
  for (const std::string& name : names) {
    if (!has_member(type, name.c_str())) reject("the records of 'trajectory' have no '" + name + "'");
    const Handle member = member_type(type, name.c_str());
    const bool whole = name == "id" || name == "frame";
    if (whole ? !is_plain_integer(member) : !is_plain_float(member))
      reject("'" + name + "' of 'trajectory' is not " + (whole ? "an integer" : "a floating-point number"));
  }
}

bool has_unsigned_ids(hid_t record) {
  return H5Tget_sign(member_type(record, "id")) == H5T_SGN_NONE;
}

/// How the records of a file lie in memory.
Handle memory_type(hid_t record) {
  Handle type(H5Tcreate(H5T_COMPOUND, sizeof(ArchiveRow)), H5Tclose, "HDF5");
  // HDF5 would turn all that are too large into the largest.
  H5Tinsert(type, "id", offsetof(ArchiveRow, id),
            has_unsigned_ids(record) ? H5T_NATIVE_UINT64 : H5T_NATIVE_INT64);
  H5Tinsert(type, "frame", offsetof(ArchiveRow, frame), H5T_NATIVE_INT64);
  H5Tinsert(type, "x", offsetof(ArchiveRow, x), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "y", offsetof(ArchiveRow, y), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "z", offsetof(ArchiveRow, z), H5T_NATIVE_DOUBLE);
  if (!has_orientation(record)) return type;
  H5Tinsert(type, "ox", offsetof(ArchiveRow, ox), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "oy", offsetof(ArchiveRow, oy), H5T_NATIVE_DOUBLE);
  return type;
}

/// Opens a dataset's type of records, checked.
Handle open_records(hid_t dataset) {
  Handle type(H5Dget_type(dataset), H5Tclose, "the dataset 'trajectory' cannot be read");
  check_type(type);
  return type;
}

/// Opens an attribute of one value.
Handle open_attribute(hid_t object, const char* name) {
  const std::string problem = std::string("the attribute '") + name + "' cannot be read";
  Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, problem.c_str());
  const Handle space(H5Aget_space(attribute), H5Sclose, problem.c_str());
  if (H5Sget_simple_extent_npoints(space) != 1)
    reject(std::string("the attribute '") + name + "' is not one value");
  return attribute;
}

/// Reads a text whose length the type says.
std::string fixed_text(hid_t attribute, hid_t type, const std::string& what) {
  std::string text(H5Tget_size(type), '\0');
  if (text.size() > longest_text) reject(what + " has more than 16 MiB");
  if (H5Aread(attribute, type, text.data()) < 0) fail(what + " cannot be read");
  return text.substr(0, text.find('\0'));
}

std::string variable_text(hid_t attribute, hid_t type, const std::string& what) {
  const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose, "HDF5");
  H5Tset_size(memory, H5T_VARIABLE);
  H5Tset_cset(memory, H5Tget_cset(type));
  char* text = nullptr;
  if (H5Aread(attribute, memory, static_cast<void*>(&text)) < 0) fail(what + " cannot be read");
  if (text == nullptr) return {};
  std::string copy(text);
  H5free_memory(text);
  if (copy.size() > longest_text) reject(what + " has more than 16 MiB");
  return copy;
}

/// Returns a text of the file itself; empty where it has none of that name.
std::string text_of(hid_t file, const char* name, const std::string& what) {
  if (H5Aexists(file, name) <= 0) return {};
  const Handle attribute = open_attribute(file, name);
  const Handle type(H5Aget_type(attribute), H5Tclose, (what + " cannot be read").c_str());
  if (H5Tget_class(type) != H5T_STRING) reject(std::string("the attribute '") + name + "' is not a text");
  return H5Tis_variable_str(type) > 0 ? variable_text(attribute, type, what)
                                      : fixed_text(attribute, type, what);
}

}  // namespace

/// What is open of a file.
struct Hdf5Recording::Handles {
  Handle file, dataset, space, record, memory;

  explicit Handles(const std::string& name)
      : file(open_file(name)),
        dataset(open_dataset(file)),
        space(H5Dget_space(dataset), H5Sclose, "the dataset 'trajectory' cannot be read"),
        record(open_records(dataset)),
        memory(memory_type(record)) {}
};

Hdf5Recording::Hdf5Recording(const std::string& file) : handles_(std::make_unique<Handles>(file)) {
  if (H5Sget_simple_extent_ndims(handles_->space) != 1)
    reject("the dataset 'trajectory' is not one-dimensional");
  check_storage(handles_->dataset, H5Tget_size(handles_->record));
}

Hdf5Recording::~Hdf5Recording() = default;

std::uint64_t Hdf5Recording::rows() const {
  hsize_t rows = 0;
  if (H5Sget_simple_extent_dims(handles_->space, &rows, nullptr) != 1)
    fail("the dataset 'trajectory' cannot be read");
  return rows;
}

double Hdf5Recording::fps() const {
  if (H5Aexists(handles_->dataset, "fps") <= 0) return 0;
  const Handle attribute = open_attribute(handles_->dataset, "fps");
  const Handle type(H5Aget_type(attribute), H5Tclose, "the attribute 'fps' cannot be read");
  if (!is_plain_integer(type) && !is_plain_float(type)) reject("the attribute 'fps' is not a number");
  double fps = 0;
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &fps) < 0) fail("the attribute 'fps' cannot be read");
  // 0 stands for a file that does not say.
  if (fps == 0) reject("the attribute 'fps' is 0 frames a second, not above 0 and at most 10000");
  return fps;
}

std::string Hdf5Recording::geometry() const {
  return text_of(handles_->file, "wkt_geometry", "its geometry");
}

bool Hdf5Recording::is_of_jupedsim() const {
  if (has_orientation(handles_->record)) return true;
  try {
    return text_of(handles_->file, "producer", "the attribute 'producer'") == "JuPedSim";
  } catch (const std::runtime_error&) {
    return false;  // what others call so may be anything
  }
}

bool Hdf5Recording::ids_are_unsigned() const {
  return has_unsigned_ids(handles_->record);
}

std::uint64_t Hdf5Recording::bytes_a_row() const {
  return H5Tget_size(handles_->record);
}

void Hdf5Recording::read(std::uint64_t first, std::span<ArchiveRow> rows) const {
  const hsize_t start = first, count = rows.size();
  const Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose, "HDF5");
  if (H5Sselect_hyperslab(handles_->space, H5S_SELECT_SET, &start, nullptr, &count, nullptr) < 0 ||
      H5Dread(handles_->dataset, handles_->memory, memory, handles_->space, H5P_DEFAULT, rows.data()) < 0)
    fail("rows from " + std::to_string(first + 1) + " on cannot be read");
  if (!has_orientation(handles_->record))
    for (ArchiveRow& row : rows) row.ox = row.oy = 0;
}

}  // namespace bch::detail::trajectory
