#include "output/hdf5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <vector>

namespace gannet {

namespace {

/// An HDF5 handle that is closed at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: handles are passed to the C functions
  [[nodiscard]] bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// HDF5 prints its own stack of errors unless told otherwise; ours say it in one line.
void be_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

hid_t native(Type type) {
  switch (type) {
    case Type::f64:
      return H5T_NATIVE_DOUBLE;
    case Type::i32:
      return H5T_NATIVE_INT32;
    case Type::i64:
      return H5T_NATIVE_INT64;
    case Type::u8:
      return H5T_NATIVE_UINT8;
  }
  return -1;
}

/// Checksummed metadata (newest format), and no file locks: some file systems have none.
hid_t access_properties() {
  const hid_t p = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(p, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  H5Pset_file_locking(p, false, true);
  return p;
}

/// Chunks of about 1 MiB with a Fletcher checksum; tables without entries stay plain.
void add_checksum(hid_t properties, const Hdf5Table& t) {
  if (t.rows == 0 || t.columns == 0) return;
  const hsize_t row_bytes = static_cast<hsize_t>(t.columns) * static_cast<hsize_t>(size_of(t.type));
  const hsize_t rows =
      std::clamp<hsize_t>((hsize_t{1} << 20) / row_bytes, 1, static_cast<hsize_t>(t.rows));
  const hsize_t chunk[2] = {rows, static_cast<hsize_t>(t.columns)};
  H5Pset_chunk(properties, 2, chunk);
  H5Pset_fletcher32(properties);
}

[[noreturn]] void cannot_write(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": cannot write " + what + " (is the disk full?)");
}

}  // namespace

Hdf5Writer::Hdf5Writer(const std::string& path) : path_(path) {
  be_quiet();
  const Handle access(access_properties(), H5Pclose);
  file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (file_ < 0) cannot_write(path_, "the file");
}

Hdf5Writer::~Hdf5Writer() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Writer::write(const Hdf5Table& t, const void* data) {
  const hsize_t size[2] = {static_cast<hsize_t>(t.rows), static_cast<hsize_t>(t.columns)};
  const Handle space(H5Screate_simple(2, size, nullptr), H5Sclose);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  add_checksum(creation, t);
  const Handle set(
      H5Dcreate2(file_, t.name.c_str(), native(t.type), space, links, creation, H5P_DEFAULT),
      H5Dclose);
  if (!set.ok()) cannot_write(path_, t.name);
  if (t.rows > 0 && t.columns > 0 &&
      H5Dwrite(set, native(t.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
    cannot_write(path_, t.name);
  }
}

void Hdf5Writer::write_text(const std::string& name, const std::string& text) {
  write({name, Type::u8, static_cast<std::int64_t>(text.size()), 1}, text.data());
}

void Hdf5Writer::close() {
  const hid_t file = file_;
  file_ = -1;
  if (H5Fclose(file) < 0) cannot_write(path_, "the file");
}

Hdf5Reader::Hdf5Reader(const std::string& path) {
  be_quiet();
  const Handle access(access_properties(), H5Pclose);
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  if (file_ < 0) throw DamagedFile("it is no whole HDF5 file");
}

Hdf5Reader::~Hdf5Reader() { H5Fclose(file_); }

void Hdf5Reader::read(const Hdf5Table& t, void* data) const {
  const Handle set(H5Dopen2(file_, t.name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.ok()) throw DamagedFile("'" + t.name + "' is missing");
  const Handle space(H5Dget_space(set), H5Sclose);
  const Handle type(H5Dget_type(set), H5Tclose);
  hsize_t size[2] = {0, 0};
  const bool fits = H5Sget_simple_extent_ndims(space) == 2 &&
                    H5Sget_simple_extent_dims(space, size, nullptr) == 2 &&
                    size[0] == static_cast<hsize_t>(t.rows) &&
                    size[1] == static_cast<hsize_t>(t.columns) &&
                    H5Tequal(type, native(t.type)) > 0;
  if (!fits) throw DamagedFile("'" + t.name + "' has another shape than the file says");
  if (t.rows == 0 || t.columns == 0) return;
  if (H5Dread(set, native(t.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
    throw DamagedFile("'" + t.name + "' cannot be read or fails its checksum");
  }
}

std::string Hdf5Reader::read_text(const std::string& name) const {
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.ok()) throw DamagedFile("'" + name + "' is missing");
  const Handle space(H5Dget_space(set), H5Sclose);
  const hssize_t n = H5Sget_simple_extent_npoints(space);
  if (n < 0) throw DamagedFile("'" + name + "' has no size");
  std::string text(static_cast<std::size_t>(n), '\0');
  read({name, Type::u8, n, 1}, text.data());
  return text;
}

}  // namespace gannet
