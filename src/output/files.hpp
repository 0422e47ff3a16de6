// The one way in which files are written. A whole file is written to a temporary name in the same
// folder and renamed, so that whatever stands under a final name is complete even if the process
// is killed. Lines are appended in one piece each.
#pragma once

#include <string>
#include <string_view>

namespace gannet {

/// True where every write is made piece by piece with short sleeps between, so that a kill may land
/// in the middle of one. False in the program; tests link another answer (slow_writes.cpp).
bool writes_are_slow();

/// Name of the temporary file of a folder; only one writer works in a folder at a time.
std::string temporary_in(const std::string& folder);

/// The same for the folder that `path` lies in.
std::string temporary_beside(const std::string& path);

enum class Durable { no, yes };

/// Writes the bytes as the file `path`: temporary name, then rename. Durable::yes also waits until
/// file and name are on the disk. Throws std::runtime_error that names the file and the cause.
void write_whole_file(const std::string& path, std::string_view bytes,
                      Durable durable = Durable::no);

/// Gives a finished temporary file its final name; see write_whole_file().
void rename_whole_file(const std::string& temporary, const std::string& path, Durable durable);

/// Waits until the content of a file is on the disk; a file that is gone is no error.
void bring_to_disk(const std::string& path);

/// A file that grows by whole lines. Each append reaches the operating system before it returns,
/// so a kill leaves at most one partial last line.
class GrowingFile {
 public:
  /// Opens or makes the file, to append. Throws std::runtime_error.
  explicit GrowingFile(const std::string& path);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;
  /// line: with its line end.
  void append(std::string_view line);
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  int file_ = -1;
};

/// A name that is safe in every file system: letters, digits, '_', '-' and '.' stay, all else
/// becomes '_'.
std::string file_name_of(const std::string& name);

}  // namespace gannet
