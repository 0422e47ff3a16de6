#include "output/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace gannet {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& doing) {
  throw std::runtime_error(fmt::format("{}: {}: {}", path, doing, std::strerror(errno)));
}

/// A file descriptor that is closed at the end of its scope.
struct Descriptor {
  int number = -1;
  explicit Descriptor(int n) : number(n) {}
  ~Descriptor() {
    if (number >= 0) close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

void write_piece(int file, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t n = write(file, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, "cannot write");
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void write_all(int file, std::string_view bytes, const std::string& path) {
  if (!writes_are_slow()) return write_piece(file, bytes, path);
  const std::size_t piece = std::min<std::size_t>(bytes.size() / 4 + 1, 16384);
  while (!bytes.empty()) {
    write_piece(file, bytes.substr(0, piece), path);
    bytes.remove_prefix(std::min(piece, bytes.size()));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Writes a finished temporary file once more, as a slow disk would.
void write_again_slowly(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const Descriptor file(open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
  if (file.number < 0) fail(path, "cannot write");
  write_all(file.number, bytes, path);
}

std::string folder_of(const std::string& path) {
  const auto parent = std::filesystem::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

}  // namespace

std::string temporary_in(const std::string& folder) { return folder + "/.unfinished.tmp"; }

std::string temporary_beside(const std::string& path) { return temporary_in(folder_of(path)); }

void bring_to_disk(const std::string& path) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number < 0) return;
  if (fsync(file.number) != 0) fail(path, "cannot bring to the disk");
}

void rename_whole_file(const std::string& temporary, const std::string& path, Durable durable) {
  if (writes_are_slow()) write_again_slowly(temporary);
  if (durable == Durable::yes) bring_to_disk(temporary);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "cannot rename to this name");
  if (durable == Durable::yes) bring_to_disk(folder_of(path));
}

void write_whole_file(const std::string& path, std::string_view bytes, Durable durable) {
  const std::string temporary = temporary_beside(path);
  {
    const Descriptor file(open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.number < 0) fail(path, "cannot write");
    write_piece(file.number, bytes, path);
  }
  rename_whole_file(temporary, path, durable);
}

GrowingFile::GrowingFile(const std::string& path)
    : path_(path), file_(open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (file_ < 0) fail(path, "cannot write");
}

GrowingFile::~GrowingFile() { close(file_); }

void GrowingFile::append(std::string_view line) { write_all(file_, line, path_); }

std::string file_name_of(const std::string& name) {
  std::string safe = name.empty() ? "_" : name;
  for (char& c : safe) {
    const bool keep =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
    if (!keep) c = '_';
  }
  if (safe.front() == '.') safe.front() = '_';
  return safe;
}

}  // namespace gannet
