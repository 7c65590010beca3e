// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/archive_file.hpp"

#include <hdf5.h>

namespace bch::test {
namespace {

hid_t made(hid_t id) {
  if (id < 0) throw std::runtime_error("an HDF5 file cannot be made");
  return id;
}

hid_t memory_type(const ArchiveFile& file) {
  const hid_t type = made(H5Tcreate(H5T_COMPOUND, sizeof(ArchiveFile::Row)));
  H5Tinsert(type, "id", offsetof(ArchiveFile::Row, id),
            file.ids_are_unsigned ? H5T_NATIVE_UINT64 : H5T_NATIVE_INT64);
  H5Tinsert(type, "frame", offsetof(ArchiveFile::Row, frame), H5T_NATIVE_INT64);
  H5Tinsert(type, "x", offsetof(ArchiveFile::Row, x), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "y", offsetof(ArchiveFile::Row, y), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, file.z.c_str(), offsetof(ArchiveFile::Row, z), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "ox", offsetof(ArchiveFile::Row, ox), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "oy", offsetof(ArchiveFile::Row, oy), H5T_NATIVE_DOUBLE);
  return type;
}

hid_t file_type(const ArchiveFile& file) {
  const std::size_t whole = file.floats ? 4 : 8;
  const hid_t integer = file.floats ? H5T_STD_I32BE : H5T_STD_I64LE,
              real = file.floats ? H5T_IEEE_F32BE : H5T_IEEE_F64LE;
  const std::size_t begin = file.has_orientation ? 2 * whole : 0;
  const hid_t type = made(H5Tcreate(H5T_COMPOUND, begin + 5 * whole));
  if (file.has_orientation) {
    H5Tinsert(type, "oy", 0, real);
    H5Tinsert(type, "ox", whole, real);
  }
  H5Tinsert(type, "id", begin, file.ids_are_unsigned ? H5T_STD_U64LE : integer);
  H5Tinsert(type, "frame", begin + whole, integer);
  H5Tinsert(type, file.z.c_str(), begin + 2 * whole, real);
  H5Tinsert(type, "x", begin + 3 * whole, file.x_is_integer ? integer : real);
  H5Tinsert(type, "y", begin + 4 * whole, real);
  return type;
}

hid_t creation(const ArchiveFile& file) {
  const hid_t list = made(H5Pcreate(H5P_DATASET_CREATE));
  hsize_t chunk[] = {file.storage == ArchiveFile::Storage::big_chunks ? hsize_t{1} << 20 : file.chunk, 1};
  using enum ArchiveFile::Storage;
  if (file.storage == deflated || file.storage == big_chunks) H5Pset_chunk(list, 1, chunk);
  if (file.storage == deflated) {
    H5Pset_shuffle(list);
    H5Pset_deflate(list, 6);
    H5Pset_fletcher32(list);
  }
  if (file.storage == scaled) {
    H5Pset_chunk(list, 1, chunk);
    H5Pset_nbit(list);
  }
  if (file.storage == external_file) H5Pset_external(list, "/dev/zero", 0, H5F_UNLIMITED);
  return list;
}

void add_text(hid_t object, const char* name, const std::string& text, bool is_fixed) {
  const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
  H5Tset_size(type, is_fixed ? text.size() : H5T_VARIABLE);
  const hid_t attribute = made(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
  const char* const start = text.c_str();
  H5Awrite(attribute, type, is_fixed ? static_cast<const void*>(start) : &start);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
}

void add_fps(hid_t dataset, const ArchiveFile& file) {
  if (file.fps_is_text) return add_text(dataset, "fps", "25", false);
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t attribute = made(H5Acreate2(dataset, "fps", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT));
  H5Awrite(attribute, H5T_NATIVE_DOUBLE, &*file.fps);
  H5Aclose(attribute);
  H5Sclose(space);
}

void add_dataset(hid_t opened, const ArchiveFile& file) {
  const bool may_grow =
      file.storage == ArchiveFile::Storage::big_chunks;  // chunks are no larger than what is there
  const hsize_t sizes[] = {file.rows.size(), 1}, unlimited[] = {H5S_UNLIMITED, H5S_UNLIMITED};
  const hid_t space = made(H5Screate_simple(file.is_plane ? 2 : 1, sizes, may_grow ? unlimited : nullptr));
  const hid_t list = creation(file), memory = memory_type(file), type = file_type(file);
  const hid_t dataset =
      made(H5Dcreate2(opened, file.name.c_str(), type, space, H5P_DEFAULT, list, H5P_DEFAULT));
  if (file.storage != ArchiveFile::Storage::external_file && !file.rows.empty())
    H5Dwrite(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, file.rows.data());
  if (file.fps) add_fps(dataset, file);
  H5Dclose(dataset);
  for (const hid_t closing : {type, memory}) H5Tclose(closing);
  H5Pclose(list);
  H5Sclose(space);
}

}  // namespace

void ArchiveFile::write(const std::filesystem::path& file) const {
  const hid_t opened = made(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  if (storage == Storage::external_link)
    H5Lcreate_external("other.h5", "/trajectory", opened, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  else if (storage == Storage::soft_link)
    H5Lcreate_soft("/elsewhere", opened, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  else
    add_dataset(opened, *this);
  if (geometry) add_text(opened, "wkt_geometry", *geometry, fixed_text);
  if (producer) add_text(opened, "producer", *producer, fixed_text);
  H5Fclose(opened);
}

}  // namespace bch::test
