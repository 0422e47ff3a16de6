// The little of HDF5 that checkpoints need: named tables and texts, each with a checksum.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "scene/field.hpp"

namespace gannet {

/// A file that is no HDF5 file, cut off, or whose content fails its checksum.
class DamagedFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where and what a table of rows x columns numbers is, packed row by row.
struct Hdf5Table {
  std::string name;  ///< "fields/x"; groups on the way are made
  Type type = Type::f64;
  std::int64_t rows = 0;
  int columns = 1;
};

/// Writes an HDF5 file piece by piece under the name it is given (a temporary one).
class Hdf5Writer {
 public:
  /// Throws std::runtime_error where the file cannot be made.
  explicit Hdf5Writer(const std::string& path);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;
  void write(const Hdf5Table& table, const void* data);
  void write_text(const std::string& name, const std::string& text);
  /// Finishes the file; throws std::runtime_error where that fails (a full disk, say).
  void close();

 private:
  std::string path_;
  std::int64_t file_ = -1;
};

/// Reads one back.
class Hdf5Reader {
 public:
  /// Throws DamagedFile where it is no whole HDF5 file.
  explicit Hdf5Reader(const std::string& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;
  /// data: room for rows x columns. Throws DamagedFile where the table is missing, has another
  /// shape or type, or fails its checksum.
  void read(const Hdf5Table& table, void* data) const;
  [[nodiscard]] std::string read_text(const std::string& name) const;

 private:
  std::int64_t file_ = -1;
};

}  // namespace gannet
